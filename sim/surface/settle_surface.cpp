#include "sim/surface/settle_surface.h"

#include "sim/grid/leaf_table.h"
#include "sim/surface/extend_into_solids.h"
#include "sim/surface/level_set.h"
#include "sim/surface/mirror_sides.h"
#include "sim/surface/redistance.h"

#include <utility>
#include <vector>

namespace fluidtex::sim {
namespace {

// Depth in solids, in voxels, from which phi is extrapolated. Cells that a wall cuts are included where their
// centre lies in it: otherwise they would be air, and the body would start by falling into their open part.
constexpr float kInSolid = 0.0f;
constexpr int kIterations = 4;

}  // namespace

void settleSurface(FloatGrid& phi, const SolidField& solid, const MaskGrid& known) {
  for (const Coord& origin : wetLeaves(phi, grown(solid.domain, kLeafDim))) phi.tree().touchLeaf(origin);
  for (auto leaf = solid.phi->constTree().cbeginLeaf(); leaf; ++leaf) phi.tree().touchLeaf(leaf->origin());
  const float h = static_cast<float>(phi.voxelSize()[0]);
  // A body that ends at a wall has no surface there (sim/surface/poured_surface.h), and one that ends before
  // it keeps its surface. Both continue straight.
  const auto never = [](const Coord&) { return false; };
  const GapRules rules{never, never};
  // Less than a cell before a wall no cell outside it tells how phi rises: beside an edge of the body it
  // rises otherwise behind the surface.
  std::vector<std::pair<Coord, float>> kept;
  for (auto it = known.cbeginValueOn(); it; ++it)
    kept.emplace_back(it.getCoord(), phi.tree().getValue(it.getCoord()));
  const auto extend = [&] {
    extendIntoSolids(phi, *solid.phi, rules, kInSolid, solid.visibility.get());
    for (const auto& [cell, value] : kept) phi.tree().setValueOnly(cell, value);
    mirrorAtSides(phi, solid);
  };
  const int rounds = static_cast<int>(phi.background() / (h * kRedistanceReach * kIterations)) + 2;
  for (int n = 0; n < rounds; ++n) {
    extend();
    redistance(phi, solid, kIterations);
  }
  extend();
  trimBand(phi, *solid.phi);
}

}  // namespace fluidtex::sim
