// How much liquid a scene will hold, from its shapes alone.
#pragma once

#include "sim/options.h"

#include <cstdint>

namespace fluidtex::pipeline {

// Counts on the solver's grid. A cell is liquid if its centre is in a body and in no solid that is there from
// the start.
struct LiquidPlan {
  std::int64_t cells = 0;    // once every body has been poured
  std::int64_t atStart = 0;  // at the first frame
  std::int64_t surfaceCells =
      0;  // of `cells`, those within one cell of the surface: its area over the square of a cell
};

// Visits cells near surfaces only. Throws sim::MeshError.
LiquidPlan planLiquid(const sim::Options& options);

}  // namespace fluidtex::pipeline
