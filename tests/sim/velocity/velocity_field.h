// A velocity given in closed form, on a staggered grid.
#pragma once

#include "sim/grid/mac_grid.h"

#include <functional>

// At every active face of this topology (of cells' lower faces), m/s.
inline fluidtex::sim::Velocity velocityField(
    double h, const fluidtex::sim::FloatTree& topology,
    const std::function<fluidtex::sim::Vec3d(const fluidtex::sim::Vec3d&)>& field) {
  fluidtex::sim::Velocity velocity = fluidtex::sim::makeVelocity(h, topology);
  for (int a = 0; a < 3; ++a) {
    fluidtex::sim::FloatGrid& grid = *velocity.component[a];
    for (auto it = grid.beginValueOn(); it; ++it) {
      it.setValue(static_cast<float>(field(grid.indexToWorld(it.getCoord()))[a]));
    }
  }
  return velocity;
}
