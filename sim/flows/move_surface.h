// The liquid's surface over one substep: level set and markers together.
#pragma once

#include "random/random.h"
#include "sim/flows/flows.h"
#include "sim/grid/mac_grid.h"
#include "sim/markers/markers.h"
#include "sim/solids/solids.h"

#include <cstdint>

namespace fluidtex::sim {

// What markers are put by after so many steps; `seed`: the scene's.
inline std::uint64_t markerSeed(std::uint64_t seed, std::int64_t steps) {
  return randomBits(streamOf(seed, Stream::markers), static_cast<std::uint64_t>(steps));
}

// Moves phi and its markers with the velocity for dt seconds, and makes phi a distance again: advection
// (advectPhi, advectMarkers), what sources and drains do, correction by the markers before and after the
// reinitialisation, and upkeep of the markers. dt max|u| / h must be below kMaxTrace (else
// std::invalid_argument); the velocity must reach that far beyond the band, into solids too. `seed` must
// differ from call to call. left: the solids' distance before the step where they move (see
// extendIntoSolids). The sequence is that of Enright et al. 2002, section 3.
void moveSurface(FloatGrid& phi, Markers& markers, const Velocity& velocity, const SolidField& solid,
                 double dt, std::uint64_t seed, const RunningFlows& flows = {},
                 const FloatGrid* left = nullptr);

}  // namespace fluidtex::sim
