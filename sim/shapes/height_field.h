// Ground from an image, as triangles.
#pragma once

#include "sim/meshes/triangle_mesh.h"
#include "sim/shapes/shape_distance.h"

namespace fluidtex::sim {

// The ground as a closed mesh, metres, sampled every `spacing` metres or a little less. Empty where the
// picture lies beside the domain. Throws HeightError.
// It ends `beyond` metres outside the domain where the picture reaches the domain's side, `beyond` outside
// the picture where the domain is infinite, else at the picture's rim. Below it ends at `base` metres or,
// where that lies higher, `beyond` below its lowest point. Heights more than `beyond` above or below the
// domain are clamped.
TriangleMesh groundMesh(const HeightField& ground, const openvdb::BBoxd& domain, double spacing,
                        double beyond, double base);

}  // namespace fluidtex::sim
