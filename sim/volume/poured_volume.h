// Volume deficit of poured liquid: the part of it that its surface does not represent.
#pragma once

#include "sim/flows/flows.h"
#include "sim/solids/solids.h"

#include <functional>

namespace fluidtex::sim {

// Bodies of liquid that have been poured at once.
struct PouredLiquid {
  const FloatGrid& bodies;                       // distance to them, metres, in leaves around them
  const FloatGrid& phi;                          // with the liquid that was there before, not yet settled
  std::function<double(const Vec3d&)> distance;  // the same as `bodies`, anywhere
  std::function<double(const Vec3d&)> solids;    // distance to solids, metres, anywhere
  bool start;                                    // no liquid was there before
};

// The deficit (null for none) with the part of poured liquid added that its surface does not represent. At
// cell centres, in units of h^3.
// Added: films and drops in which no cell centre lies outside solids; at the start, away from solids, also
// what settling, which makes phi a distance, erodes at edges and of bodies of a few cells. Nothing is added
// in sources and within a cell of drains.
// settled: phi after settling.
FloatGrid::Ptr withPoured(const FloatGrid* deficit, const PouredLiquid& poured, const FloatGrid& settled,
                          const SolidField& solid, const RunningFlows& flows);

}  // namespace fluidtex::sim
