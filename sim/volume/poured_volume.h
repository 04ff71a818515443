// What of poured liquid its surface does not show.
#pragma once

#include "sim/flows/flows.h"
#include "sim/solids/solids.h"

#include <functional>

namespace fluidtex::sim {

// Bodies of liquid that have been put in at once.
struct PouredLiquid {
  const FloatGrid& bodies;                       // distance to them, metres, in leaves around them
  const FloatGrid& phi;                          // with all that was there before, not yet settled
  std::function<double(const Vec3d&)> distance;  // the same as `bodies`, anywhere
  bool start;                                    // they are all that there is
};

// Adds to what is owed (null for nothing) what the surface does not show of liquid that is poured: films and
// drops that no cell's centre is in; and, at the start and away from solids, what settling, which makes phi a
// distance, wears off edges and bodies of a few cells. settled: phi after that. Nothing within a cell of
// sources and drains.
FloatGrid::Ptr withPoured(const FloatGrid* deficit, const PouredLiquid& poured, const FloatGrid& settled,
                          const SolidField& solid, const RunningFlows& flows);

}  // namespace fluidtex::sim
