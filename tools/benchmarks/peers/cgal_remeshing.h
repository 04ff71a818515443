// CGAL's isotropic remeshing, behind a wall of its own: its headers take long to compile.
#pragma once

#include "texture/surface.h"

namespace fluidtex::benchmarks {

struct Remeshed {
  std::vector<texture::Vec3f> positions;
  std::vector<texture::Vec3I> triangles;
  double seconds = 0.0;  // by the wall's clock, of the remeshing alone
};

// CGAL::Polygon_mesh_processing::isotropic_remeshing of a closed mesh, to the mean edge length of an even
// mesh with one vertex per unit square.
Remeshed cgalIsotropicRemeshing(const std::vector<texture::Vec3f>& positions,
                                const std::vector<texture::Vec3I>& triangles, int iterations);

}  // namespace fluidtex::benchmarks
