#include "sim/move_surface.h"

#include "sim/level_set.h"

#include <utility>

namespace fluidtex::sim {
namespace {

// In one step the surface moves at most a few cells; this many iterations renew the distance as far out.
constexpr int kReinitIterations = 8;

}  // namespace

void moveSurface(FloatGrid& phi, Markers& markers, const Velocity& velocity, const SolidField& solid,
                 double dt, std::uint64_t seed, const RunningFlows& flows, const FloatGrid* left) {
  const Visibility* const visibility = solid.visibility.get();
  markers = advectMarkers(std::move(markers), velocity, dt);
  advectPhi(phi, velocity, *solid.phi, dt, visibility);
  correctPhi(phi, markers, visibility);
  applyFlows(phi, markers, flows);
  extendBeyond(phi, solid, {}, kDeepInSolid, left);
  redistance(phi, solid, kReinitIterations);
  correctPhi(phi, markers, visibility);
  applyFlows(phi, markers, flows);
  maintainMarkers(markers, phi, *solid.phi, seed, visibility);
  trimBand(phi, *solid.phi);
}

}  // namespace fluidtex::sim
