// Shapes as triangles, for drawing.
#pragma once

#include "sim/meshes/triangle_mesh.h"
#include "sim/options.h"

#include <openvdb/openvdb.h>

namespace fluidtex::sim {

// The shape clipped to a box, as triangles for drawing. Height fields go on where they reach its high sides,
// or 0. A mesh sequence is as in its first file.
TriangleMesh triangulate(const Shape& shape, const openvdb::BBoxd& within, double voxelSize);
// The solid where it is at time t and in the shape that it has then, clipped to the box there. Planes,
// height fields, unions and differences that move are clipped before.
TriangleMesh triangulate(const Solid& solid, double t, const openvdb::BBoxd& within, double voxelSize);

}  // namespace fluidtex::sim
