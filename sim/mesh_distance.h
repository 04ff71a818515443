// The level set of a mesh in a part of space.
#pragma once

#include "sim/shapes.h"

namespace fluidtex::sim {

// Signed distance in metres at the corners of cells, negative inside, cut off at `band` cells; right in
// `region`, which may be infinite. Takes time and memory for what of the mesh lies there. bounds: of what
// lies inside and of the band, in the region, not always the smallest.
struct MeshDistance {
  openvdb::FloatGrid::ConstPtr grid;
  openvdb::BBoxd bounds;
};

// Throws std::runtime_error, whose words go on a sentence that begins with what the mesh is, where its level
// set in a box of these extents (metres) would not fit into memory.
void checkCells(const TriangleMesh& mesh, const Vec3d& extents, double voxelSize, double band);

// Of a closed mesh, turned outward; what lies between surfaces less than two cells apart stays open, as do
// cavities. Throws as checkCells().
MeshDistance meshDistanceIn(const openvdb::BBoxd& region, const TriangleMesh& mesh, double voxelSize,
                            double band);

// The mesh in pieces whose boxes do not touch, so that a level set of each tells what lies between them
// better than one that is interpolated across the gap; as a whole where these would be many.
// gap: metres by which boxes that touch may be apart.
std::vector<TriangleMesh> piecesApart(const TriangleMesh& mesh, double gap);

}  // namespace fluidtex::sim
