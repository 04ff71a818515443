// Normals of a distance function.
#pragma once

#include "sim/vec3.h"

namespace fluidtex::sim {

// The normalised gradient at x of distance(Vec3d), by central differences over `width` to both sides, in the
// same unit as x; zero where the gradient is.
template <class Distance>
Vec3d normalAt(const Distance& distance, const Vec3d& x, double width) {
  Vec3d normal;
  for (int a = 0; a < 3; ++a) {
    Vec3d step(0.0);
    step[a] = width;
    normal[a] = distance(x + step) - distance(x - step);
  }
  const double length = normal.length();
  return length > 0.0 ? normal / length : Vec3d(0.0);
}

}  // namespace fluidtex::sim
