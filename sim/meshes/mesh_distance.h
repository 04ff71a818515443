// Signed distance to a mesh.
#pragma once

#include "sim/meshes/inside_test.h"
#include "sim/meshes/triangle_mesh.h"
#include "sim/meshes/triangle_tree.h"
#include "sim/vec3.h"

#include <memory>

namespace fluidtex::sim {

// Signed distance in metres, negative inside, clamped at some cells: exact within kExactMeshBand cells, else
// trilinear between the corners of cells, where it is known. Valid in a region.
struct MeshDistance {
  openvdb::FloatGrid::ConstPtr corners;
  // The surface, without the parts of it that lie inside another part of the mesh. Null where nothing is
  // near.
  std::shared_ptr<const TriangleTree> surface;
  std::shared_ptr<const InsideTest> inside;
  openvdb::BBoxd bounds;  // of the inside and the narrow band, in the region, not always the smallest

  double at(const Vec3d& x) const;
};

// In cells. Farther away interpolated distances are too small only in the middle of walls and gaps that are
// thicker than three cells, where nothing depends on it.
inline constexpr double kExactMeshBand = 1.5;

// Throws std::runtime_error where the mesh's level set in a box of these extents (metres) would not fit into
// memory. The message continues a sentence that begins with what the mesh is.
void checkCells(const TriangleMesh& mesh, const Vec3d& extents, double voxelSize, double band);

// Distance to a closed mesh that is turned outward, clamped at `band` cells; valid in `region`, which may be
// infinite. Takes time and memory for the part of the mesh there. Throws as checkCells().
MeshDistance meshDistanceIn(const openvdb::BBoxd& region, const TriangleMesh& mesh, double voxelSize,
                            double band);

}  // namespace fluidtex::sim
