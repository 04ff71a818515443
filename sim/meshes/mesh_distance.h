// How far away a mesh is.
#pragma once

#include "sim/meshes/inside_test.h"
#include "sim/meshes/triangle_mesh.h"
#include "sim/meshes/triangle_tree.h"
#include "sim/vec3.h"

#include <memory>

namespace fluidtex::sim {

// Signed distance in metres, negative inside, cut off at some cells: exact within kExactMeshBand cells, else
// trilinear between the corners of cells, where it is known. Right in a region.
struct MeshDistance {
  openvdb::FloatGrid::ConstPtr corners;
  // What is a surface: not what of one part of a mesh lies within another. Null where nothing is near.
  std::shared_ptr<const TriangleTree> surface;
  std::shared_ptr<const InsideTest> inside;
  openvdb::BBoxd bounds;  // of what lies inside and of the band, in the region, not always the smallest

  double at(const Vec3d& x) const;
};

// In cells. Farther away interpolated distances are less only in the middle of walls and gaps that are
// thicker than three cells, where nothing depends on it.
inline constexpr double kExactMeshBand = 1.5;

// Throws std::runtime_error, whose words go on a sentence that begins with what the mesh is, where its level
// set in a box of these extents (metres) would not fit into memory.
void checkCells(const TriangleMesh& mesh, const Vec3d& extents, double voxelSize, double band);

// Of a closed mesh, turned outward, cut off at `band` cells; right in `region`, which may be infinite. Takes
// time and memory for what of the mesh lies there. Throws as checkCells().
MeshDistance meshDistanceIn(const openvdb::BBoxd& region, const TriangleMesh& mesh, double voxelSize,
                            double band);

}  // namespace fluidtex::sim
