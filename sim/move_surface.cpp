#include "sim/move_surface.h"

#include "sim/level_set.h"

#include <utility>

namespace fluidtex::sim {
namespace {

// In one step the surface moves at most a few cells; this many iterations renew the distance as far out.
constexpr int kReinitIterations = 8;

}  // namespace

void moveSurface(FloatGrid& phi, Markers& markers, const Velocity& velocity, const FloatGrid& solidPhi,
                 double dt, std::uint64_t seed, const RunningFlows& flows) {
  markers = advectMarkers(std::move(markers), velocity, dt);
  advectPhi(phi, velocity, solidPhi, dt);
  correctPhi(phi, markers);
  applyFlows(phi, markers, flows);
  extendIntoSolids(phi, solidPhi);
  reinitialize(phi, solidPhi, kReinitIterations);
  correctPhi(phi, markers);
  applyFlows(phi, markers, flows);
  maintainMarkers(markers, phi, solidPhi, seed);
  trimBand(phi, solidPhi);
}

}  // namespace fluidtex::sim
