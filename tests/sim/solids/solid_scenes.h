// Tanks of one metre with solids in them.
#pragma once

#include "sim/options.h"

#include <utility>
#include <vector>

namespace fluidtex::sim {

inline Options tankWith(int resolution, std::vector<Solid> solids = {}) {
  Options options;
  options.resolution = resolution;
  options.solids = std::move(solids);
  return options;
}

inline Solid solidOf(Shape shape, double from = 0.0, double until = kForever) {
  Solid solid;
  solid.shape = std::move(shape);
  solid.from = from;
  solid.until = until;
  return solid;
}

}  // namespace fluidtex::sim
