// The liquid of a program that links the library: surfaces and velocities in memory, as a source of frames.
#pragma once

#include "caches/liquid/read_frame.h"
#include "sim/frame/frame.h"

#include <openvdb/openvdb.h>

#include <optional>
#include <vector>

namespace fluidtex::pipeline {

// A frame of a liquid from grids. The surface is phi = 0, negative inside; phi has cubic voxels and any
// position. Only values beside the surface are used, so phi need not be a distance. velocity: m/s, at the
// voxels' centres, active where known; required around the surface of this frame and where it moves until the
// next. Null: unknown; then the velocity of the frame before or after is used, and the liquid is at rest
// where neither has one. Throws std::invalid_argument if phi's voxels are not cubes, an active value is not
// finite, or the surface crosses more than 3e7 cells or reaches farther than 4e6 cells from the origin.
caches::LiquidFrame liquidOf(const openvdb::FloatGrid& phi, const openvdb::Vec3SGrid::Ptr& velocity);

// The same out of a mesh, closed and in metres, and the velocity of its points (#P, m/s; empty: as null
// above). h: side of the cells of its level set, metres; the mesh's mean edge suits. seconds: until the next
// frame. What encloses nothing becomes a sheet one and a half cells thick. Throws std::invalid_argument: h is
// not above 0; a triangle's corner is no point; values that are not finite; not a velocity for each point;
// more than 3e7 cells, or farther than 4e6 cells from the origin.
caches::LiquidFrame liquidOf(caches::SurfaceTriangles mesh, const std::vector<openvdb::Vec3f>& velocity,
                             double h, double seconds);

// Frames for textureFrame(), from one liquid to the next.
class GivenFlow {
 public:
  // seconds: since the previous frame; not used in the first call. A frame's motion is made of the velocities
  // at its begin and end, mixed so that they carry the last surface as near to this one as they can
  // (caches/liquid/explained.h); FrameStats::explained says how near. Throws std::invalid_argument if seconds
  // is not above 0 or not finite, in the first call too.
  sim::Frame next(caches::LiquidFrame now, double seconds);

 private:
  std::optional<caches::LiquidFrame> m_last;
  int m_frame = 0;
  double m_time = 0.0;
};

}  // namespace fluidtex::pipeline
