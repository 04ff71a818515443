// The marker-and-cell (staggered) grid on OpenVDB trees: where samples sit, and how kernels read them.
//
// Cell (i,j,k) is the cube [i h, (i+1) h] x ...; its centre, where phi sits, is ((i+1/2) h, ...).
// u(i,j,k) sits in the middle of that cell's lower x face, (i h, (j+1/2) h, (k+1/2) h); v and w likewise.
// The domain is [0, size], extended on unbounded sides (see sim/solids/domain.h). Other cells lie beyond its
// sides, in walls where these are closed; a few layers of them hold values so that stencils need no special
// cases.
#pragma once

#include "sim/grid/grids.h"
#include "sim/vec3.h"

#include <openvdb/openvdb.h>

#include <array>
#include <vector>

namespace fluidtex::sim {

using openvdb::Coord;
using openvdb::CoordBBox;
using FloatLeaf = FloatTree::LeafNodeType;

inline constexpr int kLeafDim = FloatLeaf::DIM;    // 8
inline constexpr int kLeafSize = FloatLeaf::SIZE;  // 512, z fastest: offset = 64 i + 8 j + k
inline constexpr int kLeafStride[3] = {64, 8, 1};

// The farthest that anything is traced along the velocity in one step, in cells: a leaf and its neighbours
// hold the samples needed.
inline constexpr double kMaxTrace = 5.0;

// The lowest cell of the leaf that a cell lies in.
inline Coord leafOrigin(const Coord& cell) {
  constexpr int kMask = ~(kLeafDim - 1);
  return Coord(cell.x() & kMask, cell.y() & kMask, cell.z() & kMask);
}

// Index to world for cell centres, and for the lower faces normal to `axis` (0, 1, 2).
openvdb::math::Transform::Ptr cellTransform(double h);
openvdb::math::Transform::Ptr faceTransform(double h, int axis);

// Cells along each axis: the fewest that cover [0, size].
Coord cellCount(const Vec3d& size, double h);

// The box of cells from the origin on.
CoordBBox firstCells(const Coord& count);

// Extent of an unbounded domain from the origin, in cells.
inline constexpr int kEndless = 1 << 22;

// The cells that touch a box in metres, clamped to kEndless.
CoordBBox cellsIn(const openvdb::BBoxd& box, double h);

// Whether a box of cells is unbounded on some side.
bool isEndless(const CoordBBox& box);

// The box and `layers` of cells around it.
CoordBBox grown(CoordBBox box, int layers);

// Values at faces: component[a] holds those of the faces normal to axis a; the value at (i,j,k) is that of
// the cell's lower face.
template <class Grid>
struct OnFaces {
  std::array<typename Grid::Ptr, 3> component;  // u, v, w

  // Whether there are grids: all three, or none.
  explicit operator bool() const { return component[0] != nullptr; }
  const Grid& operator[](int axis) const { return *component[axis]; }
};
using FaceGrids = OnFaces<FloatGrid>;
using FaceMasks = OnFaces<MaskGrid>;

// Face velocities in m/s; of one topology, background 0.
using Velocity = FaceGrids;

// Empty grids with the transforms above. phi is marked as a level set.
FloatGrid::Ptr makePhi(double h, double background);
Velocity makeVelocity(double h);

Velocity copyOf(const Velocity& velocity);

// Makes every face active that is active in any of the three components, so that they have one topology
// again.
void uniteTopology(Velocity& velocity);

// A velocity of value 0 with the topology of `like` (leaves, active voxels).
Velocity makeVelocity(double h, const FloatTree& like);

// The leaves of a tree in the tree's own order, which depends on their coordinates only.
std::vector<FloatLeaf*> leavesOf(FloatTree& tree);
std::vector<const FloatLeaf*> leavesOf(const FloatTree& tree);

// Copies the values of the box [origin - halo, origin + 8 + halo) into `out`, (8 + 2 halo)^3 floats, z
// fastest. origin: of a leaf; missing leaves give the tree's value there (background, tile). crossOnly:
// leaves out the parts of the box that are off the origin's leaf along more than one axis.
// Throws std::invalid_argument where halo exceeds 8.
void gather(const FloatTree& tree, const Coord& origin, int halo, float* out, bool crossOnly = false);

// Largest |component| over the active values; infinity when one is not finite.
double maxAbs(const Velocity& velocity);

}  // namespace fluidtex::sim
