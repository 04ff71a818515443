// Closest points on a mesh by others' trees.
#pragma once

#include "texture/surface.h"

namespace fluidtex::benchmarks {

struct ClosestRun {
  double build = 0.0, query = 0.0;  // processor seconds
  double sum = 0.0;                 // of the distances, to see that all find the same
};

// Embree's point queries over its BVH, with a triangle test of our own, as its interface asks for.
ClosestRun embreeClosest(const std::vector<texture::Vec3f>& positions,
                         const std::vector<texture::Vec3I>& triangles,
                         const std::vector<texture::Vec3f>& queries);

// CGAL's AABB tree, in double precision, with its points for first guesses.
ClosestRun cgalClosest(const std::vector<texture::Vec3f>& positions,
                       const std::vector<texture::Vec3I>& triangles,
                       const std::vector<texture::Vec3f>& queries);

}  // namespace fluidtex::benchmarks
