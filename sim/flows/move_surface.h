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

struct SurfaceMove {
  const Velocity& velocity;
  const SolidField& solid;  // after the step
  double dt = 0.0;          // s
  std::uint64_t seed = 0;   // differs from call to call
  // The solids' distance before the step where they move (see extendIntoSolids); null where they do not.
  const FloatGrid* left = nullptr;
};

// Moves phi and its markers with the velocity for dt seconds, and makes phi a distance again: advection
// (advectPhi, advectMarkers), sources and drains, correction by the markers before and after the
// reinitialisation, and reseeding of the markers. The sequence is that of Enright et al. 2002, section 3.
// Preconditions: dt max|u| / h is below kMaxTrace (else throws std::invalid_argument); the velocity reaches
// that far beyond the narrow band, into solids too.
void moveSurface(FloatGrid& phi, Markers& markers, const SurfaceMove& move, const RunningFlows& flows = {});

}  // namespace fluidtex::sim
