// What is measured in a state of the solver.
#pragma once

#include "sim/solids/solids.h"
#include "sim/step/solver.h"

#include <string>

namespace fluidtex::stress {

using sim::Coord;
using sim::Vec3d;

// The largest of something, and where (metres).
struct Peak {
  double value = 0.0;
  Vec3d place{0.0};
};

struct Measures {
  // J, of motion at the time that the velocity is for; of place, measured from the domain's lowest corner,
  // with the volume deficit in its place; of the surface.
  double kinetic = 0.0, potential = 0.0, surface = 0.0;
  // J, of motion of the volume deficit: it moves as what of the liquid is seen in its cell, by the velocity
  // of the liquid or the air there; beyond the narrow band, where the solver knows none, as all that is seen
  // does on the whole.
  double deficitMotion = 0.0;
  // J, of motion that the cells which the surface crosses would have if they were full.
  double surfaceMotion = 0.0;
  double area = 0.0;     // m2, of the surface between liquid and air
  double mass = 0.0;     // kg, without the volume deficit
  double thin = 0.0;     // m3, of what phi shows with nothing deeper than a cell beside it: sheets, threads
  double falling = 0.0;  // W, by which the potential energy falls
  Peak speed;            // m/s, of cells of liquid
  Peak deficit;          // largest amount in a cell, in cells
  double lowest = 0.0;   // least of -gravity . x of a cell of liquid, m2/s2
};

// solid: at the state's time, around its liquid. How much of a cell is liquid is what the solver says
// (sim/surface/cell_volume.h), so that the mass is that of the volume in sim::FrameStats.
Measures measure(const sim::State& state, const sim::SolidField& solid, const sim::Options& options);

// The name of the first grid that has a value that is not finite; empty for none.
std::string notFinite(const sim::State& state);

// What two states do not have in common, bit for bit, and where; empty for nothing.
std::string difference(const sim::State& a, const sim::State& b);

// "(x, y, z)", metres.
std::string written(const Vec3d& place);

}  // namespace fluidtex::stress
