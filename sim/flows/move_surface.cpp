#include "sim/flows/move_surface.h"

#include "sim/markers/drop_markers.h"
#include "sim/solids/solid_layers.h"
#include "sim/surface/advect_phi.h"
#include "sim/surface/extend_into_solids.h"
#include "sim/surface/level_set.h"
#include "sim/surface/redistance.h"

#include <utility>

namespace fluidtex::sim {
namespace {

// The surface moves at most a few cells in a step; this many iterations renew the distance that far out.
constexpr int kReinitIterations = 8;

// Places that a solid has just left take the values of what is beside them now. Markers there belong to a
// surface that was only extrapolated behind the solid's.
void dropLeft(Markers& markers, const FloatGrid& left) {
  const float deep = -kDeepInSolid * static_cast<float>(left.voxelSize()[0]);
  dropMarkers(markers,
              [&](const Marker&, const Coord& cell) { return left.constTree().getValue(cell) < deep; });
}

}  // namespace

void moveSurface(FloatGrid& phi, Markers& markers, const SurfaceMove& move, const RunningFlows& flows) {
  const auto& [velocity, solid, dt, seed, left] = move;
  const Visibility* const visibility = solid.visibility.get();
  markers = advectMarkers(std::move(markers), velocity, dt, visibility);
  if (left != nullptr) dropLeft(markers, *left);
  advectPhi(phi, velocity, *solid.phi, dt, visibility);
  correctPhi(phi, markers, *solid.phi, visibility);
  applyFlows(phi, markers, *solid.phi, flows);
  extendBeyond(phi, solid, {}, kDeepInSolid, left);
  redistance(phi, solid, kReinitIterations);
  correctPhi(phi, markers, *solid.phi, visibility);
  applyFlows(phi, markers, *solid.phi, flows);
  maintainMarkers(markers, phi, *solid.phi, seed, visibility);
  trimBand(phi, *solid.phi);
}

}  // namespace fluidtex::sim
