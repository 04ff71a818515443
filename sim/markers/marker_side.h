// The cell of a marker in its block, and the side of the surface that it belongs to.
#pragma once

#include "sim/markers/markers.h"

#include <cmath>

namespace fluidtex::sim {

// 0..511, as leaves count their voxels: the cell whose centre is the lower corner of the cube around the
// marker.
inline int cellOf(const Marker& m) {
  return 64 * int(m.x) + 8 * int(m.y) + int(m.z);
}

// -1 for a liquid marker, 1 for an air marker: the sign of phi where it belongs.
inline float sideOf(const Marker& m) {
  return m.radius < 0.0f ? -1.0f : 1.0f;
}

// Whether a marker is on the wrong side of the surface by more than its radius. phi: at the marker, in cells.
inline bool escaped(const Marker& m, float phi) {
  return sideOf(m) * phi < -std::abs(m.radius);
}

}  // namespace fluidtex::sim
