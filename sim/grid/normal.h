// Normals of a distance function.
#pragma once

#include "sim/grid/grids.h"
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

// The same at a cell's centre, from the distances at the cells beside it.
inline Vec3d normalAt(const FloatTree& distance, const openvdb::Coord& cell) {
  Vec3d normal;
  for (int a = 0; a < 3; ++a) {
    openvdb::Coord low = cell, high = cell;
    low[a] -= 1;
    high[a] += 1;
    normal[a] = double(distance.getValue(high)) - distance.getValue(low);
  }
  const double length = normal.length();
  return length > 0.0 ? normal / length : Vec3d(0.0);
}

}  // namespace fluidtex::sim
