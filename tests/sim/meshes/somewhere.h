// Places in the unit cube.
#pragma once

#include "sim/options.h"

#include <cmath>

namespace fluidtex::sim {

// Another place for each n, all of them spread evenly.
inline Vec3d somewhere(int n) {
  const auto share = [&](double step) { return std::fmod((n + 1) * step, 1.0); };
  return {share(0.8191725134), share(0.6710436067), share(0.5497004779)};
}

}  // namespace fluidtex::sim
