// A liquid of which frames are recorded.
#pragma once

#include "sim/options.h"

namespace fluidtex::caches {

// A hot block that falls: the second frame has substeps, solids and a field.
inline sim::Options block() {
  sim::Options options;
  options.size = sim::Vec3d(0.7, 0.5, 0.6);
  options.resolution = 14;
  options.heat.simulated = true;
  options.liquid.push_back({.shape = {sim::Box{{0.1, 0.1, 0.1}, {0.4, 0.4, 0.4}}}, .temperature = 350.0});
  return options;
}

}  // namespace fluidtex::caches
