#include "sim/step/describe_liquid.h"

#include "sim/surface/level_set.h"

namespace fluidtex::sim {
namespace {

// Half width of the textured surface's narrow band, voxels.
constexpr int kSurfaceBand = 5;

}  // namespace

void describeLiquid(Frame& frame, const FloatGrid& phi, const SolidField& solid) {
  const auto surface = toOpenVdb(*visibleSurface(phi, solid, kSurfaceBand));
  surface->setTransform(cellTransform(solid.voxelSize));
  frame.surfacePhi = surface;
  frame.solidPhi = solid.phi;
  frame.stats.cells = liquidCells(phi, solid);
  frame.stats.volume = liquidVolume(phi, solid);
}

}  // namespace fluidtex::sim
