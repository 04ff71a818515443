// Velocity of a frame on grids of the world's axes, m/s, whatever grids a cache has it on.
#pragma once

#include "sim/grid/mac_grid.h"

#include <openvdb/openvdb.h>

#include <array>
#include <vector>

namespace fluidtex::caches {

// Velocity as a cache holds it: one grid of vectors, or three of numbers.
struct RawVelocity {
  openvdb::Vec3SGrid::Ptr vectors;
  std::array<openvdb::FloatGrid::Ptr, 3> numbers;
  bool onFaces = false;          // vectors: component a of voxel x lies half a voxel below its centre along a
  openvdb::Mat4d worldFromFile;  // after each grid's own transform
  openvdb::Mat3d velocityFromFile;  // v_world = m.transform(v)
};

// Where its active values lie, in the world; empty where there are none.
openvdb::BBoxd boundsOf(const RawVelocity& raw);

// One grid a component, each with a transform of its own, active where the file's is. Where the grids' axes
// are the world's (not turned, sheared or mirrored), values are copied and keep their places; else they are
// interpolated linearly at the centres of the cells of phi, in the leaves within `reach` metres of the
// surface.
sim::FaceGrids velocityGrids(const RawVelocity& raw, const openvdb::FloatGrid& phi, double reach);

// From grids of vectors at the centres of cells, as continuedOff() makes them.
sim::FaceGrids velocityGrids(const std::vector<openvdb::FloatGrid::Ptr>& components);

// Leaves (8 cells of side h) within `reach` metres of the level set's active cells.
sim::MaskTree::Ptr leavesNear(const openvdb::FloatGrid& phi, double reach);

// (1 - t) a + t b where both are active, else the one that is. One topology for each component. Both must
// have the same transforms.
sim::FaceGrids blended(const sim::FaceGrids& a, const sim::FaceGrids& b, double t);

// Whether there are no grids, or none of them has an active value.
bool isUnknown(const sim::FaceGrids& velocity);

// Whether grids of both have the same transforms.
bool sameTransforms(const sim::FaceGrids& a, const sim::FaceGrids& b);

}  // namespace fluidtex::caches
