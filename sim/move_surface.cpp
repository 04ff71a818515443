#include "sim/move_surface.h"

#include "sim/level_set.h"

namespace fluidtex::sim {
namespace {

// Every reinitialisation of the cells next to the surface costs volume (the dam break at 32 cells ends with
// 0.80 of it when done each time, with 0.87 this way, both without markers), so they are let be until their
// slopes have drifted this far.
constexpr double kKeepSlope = 0.2;
// In one step the surface moves at most a few cells; this many iterations renew the distance as far out.
constexpr int kReinitIterations = 8;

}  // namespace

void moveSurface(FloatGrid& phi, Markers& markers, const Velocity& velocity, const FloatGrid& solidPhi,
                 double dt, std::uint64_t seed, const RunningFlows& flows) {
  markers = advectMarkers(markers, velocity, dt);
  advectPhi(phi, velocity, dt);
  correctPhi(phi, markers);
  applyFlows(phi, markers, flows);
  extendIntoSolids(phi, solidPhi);
  reinitialize(phi, solidPhi, {.iterations = kReinitIterations, .keepSlope = kKeepSlope});
  correctPhi(phi, markers);
  applyFlows(phi, markers, flows);
  maintainMarkers(markers, phi, solidPhi, seed);
  trimBand(phi, solidPhi);
}

}  // namespace fluidtex::sim
