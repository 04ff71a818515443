// Shapes as triangles, for drawing.
#pragma once

#include "sim/meshes/triangle_mesh.h"
#include "sim/options.h"

#include <openvdb/openvdb.h>

namespace fluidtex::sim {

// The shape clipped to a box, as triangles for drawing. Height fields extend beyond their rim where they
// reach the box's high sides, or 0. A mesh sequence is as in its first file.
TriangleMesh triangulate(const Shape& shape, const openvdb::BBoxd& within, double voxelSize);
// The solid in its pose and shape at time t, clipped to the box there. Moving planes, height fields, unions
// and differences are clipped before the motion.
TriangleMesh triangulate(const Solid& solid, double t, const openvdb::BBoxd& within, double voxelSize);

}  // namespace fluidtex::sim
