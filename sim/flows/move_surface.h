// The liquid's surface over one substep: level set and markers together.
#pragma once

#include "numerics/random.h"
#include "sim/flows/flows.h"
#include "sim/grid/mac_grid.h"
#include "sim/markers/markers.h"
#include "sim/solids/solids.h"

#include <cstdint>

namespace fluidtex::sim {

// Seed for placing markers after so many steps; `seed`: the scene's.
inline std::uint64_t markerSeed(std::uint64_t seed, std::int64_t steps) {
  return randomBits(streamOf(seed, Stream::markers), static_cast<std::uint64_t>(steps));
}

// Moves phi and its markers with the velocity for dt seconds, and makes phi a distance again: advection
// (advectPhi, advectMarkers), sources and drains, correction by the markers before and after the
// reinitialisation, and reseeding of the markers. The sequence is that of Enright et al. 2002, section 3.
// Preconditions: dt max|u| / h is below kMaxTrace (else throws std::invalid_argument); the velocity reaches
// that far beyond the narrow band, into solids too; `seed` differs from call to call.
// left: the solids' distance before the step where they move (see extendIntoSolids).
void moveSurface(FloatGrid& phi, Markers& markers, const Velocity& velocity, const SolidField& solid,
                 double dt, std::uint64_t seed, const RunningFlows& flows = {},
                 const FloatGrid* left = nullptr);

}  // namespace fluidtex::sim
