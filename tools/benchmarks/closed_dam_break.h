// The dam break that peers were measured on: a closed box of 1 m, liquid x < 0.4, z < 0.5 over the full
// width, without friction, 24 frames a second.
#pragma once

#include "sim/options.h"

namespace fluidtex::benchmarks {

inline constexpr double kCfl = 4.0;

inline sim::Options closedDamBreak(int resolution) {
  sim::Options options;
  options.resolution = resolution;
  options.viscosity = 0.0;
  options.cfl = kCfl;
  options.liquid = {{{sim::Box{sim::Vec3d(0.0), sim::Vec3d(0.4, 1.0, 0.5)}}}};
  return options;
}

}  // namespace fluidtex::benchmarks
