// A ball in a box of one metre, 32 cells long.
#pragma once

#include "sim/options.h"

inline fluidtex::sim::Options ball(const fluidtex::sim::Vec3d& center, double radius) {
  fluidtex::sim::Options options;
  options.resolution = 32;
  options.cfl = 1.0;
  options.liquid = {{fluidtex::sim::Shape{fluidtex::sim::Sphere{center, radius}}}};
  return options;
}
