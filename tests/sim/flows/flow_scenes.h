// Scenes that the tests of flows begin with, and what they measure.
#pragma once

#include "sim/step/solver.h"

#include <algorithm>
#include <cmath>

namespace fluidtex::sim {

inline LiquidBody box(const Vec3d& min, const Vec3d& max, const Vec3d& velocity = Vec3d(0.0)) {
  return {Shape{Box{min, max}}, velocity, 0.0};
}

// A channel along x, 2 x 0.5 x 0.5 m, of cells of 1/24 m.
inline Options channel() {
  Options options;
  options.size = Vec3d(2.0, 0.5, 0.5);
  options.resolution = 48;
  return options;
}

// The largest difference of the velocity of liquid from (speed, 0, 0).
inline double largestDifference(const State& state, double speed) {
  double largest = 0.0;
  const FloatGrid::Ptr grids[3] = {state.velocity.component[0], state.velocity.component[1],
                                   state.velocity.component[2]};
  for (int a = 0; a < 3; ++a) {
    for (auto it = grids[a]->cbeginValueOn(); it; ++it) {
      const Coord c = it.getCoord();
      Coord low = c;
      low[a] -= 1;
      const bool inside = c[0] >= 0 && c[1] >= 0 && c[2] >= 0 && c[0] <= 48 && c[1] < 12 && c[a] > 0;
      const bool wet = state.phi->tree().getValue(c) < 0.0f || state.phi->tree().getValue(low) < 0.0f;
      if (inside && wet) largest = std::max(largest, std::abs(*it - (a == 0 ? speed : 0.0)));
    }
  }
  return largest;
}

// How much liquid, m3, comes in from the first frame to so many later.
inline double givenIn(Solver& solver, int frames) {
  const FrameStats first = solver.next().stats;
  FrameStats last = first;
  for (int n = 0; n < frames; ++n) last = solver.next().stats;
  return last.volume + last.deficit - first.volume - first.deficit;
}

}  // namespace fluidtex::sim
