// How far the liquid's velocities are from a field.
#pragma once

#include "sim/step/liquid.h"

#include <algorithm>
#include <cmath>

namespace fluidtex::validation {

// Largest difference of a velocity component from the field, over the faces that have liquid on both sides,
// m/s. field(x): m/s, at world positions.
template <class Field>
double farthestFrom(const sim::State& state, const Field& field) {
  const auto phi = state.phi->getConstUnsafeAccessor();
  double most = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto& grid = state.velocity.component[axis];
    for (auto it = grid->cbeginValueOn(); it; ++it) {
      sim::Coord below = it.getCoord();
      below[axis] -= 1;
      if (phi.getValue(it.getCoord()) >= 0.0f || phi.getValue(below) >= 0.0f) continue;
      const double exact = field(grid->indexToWorld(it.getCoord()))[axis];
      most = std::max(most, std::abs(*it - exact));
    }
  }
  return most;
}

// Largest velocity component on these faces, m/s.
inline double fastestOf(const sim::State& state) {
  return farthestFrom(state, [](const sim::Vec3d&) { return sim::Vec3d(0.0); });
}

}  // namespace fluidtex::validation
