// The liquid of a program that links the library: surfaces and velocities in memory, as a source of frames.
#pragma once

#include "caches/liquid/read_frame.h"
#include "sim/frame/frame.h"

#include <openvdb/openvdb.h>

#include <optional>
#include <vector>

namespace fluidtex::pipeline {

// A frame of a liquid out of grids. The surface is phi = 0, negative inside, with grids of any place and
// voxels, which are cubes; of its values only those beside the surface count, so it need be no distance.
// velocity: m/s, at the voxels' centres, active where known; needed where the surface is in this frame and
// where it goes until the next. Null: unknown, and the frame before or after has the say; the liquid rests
// where neither has. Throws std::invalid_argument where voxels are not cubes or a value is not finite.
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
  // seconds: since the last frame; before the first it says nothing. A frame's motion is that of its begin's
  // and end's velocities, mixed so that they carry the last surface as near to this one as they can
  // (caches/liquid/explained.h); FrameStats::explained says how near. Throws std::invalid_argument if
  // seconds is not above 0.
  sim::Frame next(caches::LiquidFrame now, double seconds);

 private:
  std::optional<caches::LiquidFrame> m_last;
  int m_frame = 0;
  double m_time = 0.0;
};

}  // namespace fluidtex::pipeline
