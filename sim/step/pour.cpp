#include "sim/step/pour.h"

#include "sim/flows/move_surface.h"
#include "sim/grid/leaf_table.h"
#include "sim/heat/heat.h"
#include "sim/scalars/carried_scalar.h"
#include "sim/solids/visibility.h"
#include "sim/step/liquid_fields.h"
#include "sim/surface/level_set.h"
#include "sim/surface/settle_surface.h"

#include <tbb/parallel_for.h>

namespace fluidtex::sim {

namespace {

// Whether a cell is on the body's side of thin walls: it sees a cell of the body beside it, or there is none.
bool isOnSideOf(const ShapeDistance& body, const SolidField& solid, const Coord& cell) {
  if (solid.visibility == nullptr || solid.visibility->around(cell) == nullptr) return true;
  bool hidden = false;
  for (int n = 0; n < 27; ++n) {
    const Coord at = cell.offsetBy(n / 9 - 1, n / 3 % 3 - 1, n % 3 - 1);
    if (body(solid.phi->indexToWorld(at)) >= 0.0) continue;
    if (!solid.visibility->hides(cell, at)) return true;
    hidden = true;
  }
  return !hidden;
}

}  // namespace

void pour(Liquid& liquid, const ShapeDistance& body, const std::function<double(const Vec3d&)>& surface,
          const LiquidBody& values, const SolidField& solid) {
  unite(*liquid.phi, body, solid.domain, surface);
  const Velocity before = liquid.velocity;
  liquid.velocity = velocityFor(*liquid.phi, solid);
  const auto onOwnSide = [&](const Vec3d& x) {
    const double distance = body(x);
    const Coord cell = Coord::round(liquid.phi->worldToIndex(x));
    return distance >= voxelSize(liquid) || isOnSideOf(body, solid, cell) ? distance : kForever;
  };
  for (const CarriedScalar& scalar : kCarriedScalars) {
    FloatGrid::Ptr& grid = liquid.*scalar.grid;
    if (grid == nullptr) continue;
    grid = makeScalar(*grid, liquid.velocity.component[0]->constTree());
    setInBody(*grid, onOwnSide, values.*scalar.ofBody);
  }
  const double h = voxelSize(liquid);
  for (int a = 0; a < 3; ++a) {
    FloatGrid& grid = *liquid.velocity.component[a];
    const auto leaves = leavesOf(grid.tree());
    tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
      FloatLeaf& leaf = *leaves[n];
      float scratch[kLeafSize];
      const float* was = leafValues(before.component[a]->constTree(), leaf.origin(), scratch);
      for (auto it = leaf.beginValueOn(); it; ++it) {
        // Faces of the body's cells: within half a cell of it.
        const Coord face = it.getCoord();
        Coord below = face;
        below[a] -= 1;
        const bool inBody = body(grid.indexToWorld(face)) < 0.5 * h &&
                            (isOnSideOf(body, solid, face) || isOnSideOf(body, solid, below));
        it.setValue(inBody ? static_cast<float>(values.velocity[a]) : was[it.pos()]);
      }
    });
  }
}

void changeSolids(Liquid& liquid, const SolidField& before, const SolidField& after) {
  const float h = static_cast<float>(voxelSize(liquid));
  MaskGrid left;
  for (const Coord& origin : wetLeaves(*liquid.phi, after.domain)) {
    float beforeScratch[kLeafSize], afterScratch[kLeafSize];
    const float* was = leafValues(before.phi->constTree(), origin, beforeScratch);
    const float* is = leafValues(after.phi->constTree(), origin, afterScratch);
    for (int i = 0; i < kLeafSize; ++i) {
      if (was[i] < h && is[i] > was[i]) left.tree().setValueOn(origin.offsetBy(i >> 6, (i >> 3) & 7, i & 7));
    }
  }
  cutSolids(*liquid.phi, *before.phi, left);
}

bool settle(Liquid& liquid, const SolidField& solid, double kick, const Options& options, StepReport* report,
            const RunningFlows& flows, const MaskGrid& known) {
  FloatGrid& phi = *liquid.phi;
  applyFlows(phi, liquid.markers, *solid.phi, flows);
  settleSurface(phi, solid, known);
  liquid.markers =
      seedMarkers(phi, *solid.phi, markerSeed(options.seed, liquid.steps), solid.visibility.get());

  const Velocity before = liquid.velocity;
  liquid.velocity = velocityFor(phi, solid);
  for (int a = 0; a < 3; ++a) {
    const auto leaves = leavesOf(liquid.velocity.component[a]->tree());
    tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
      float scratch[kLeafSize];
      const float* was = leafValues(before.component[a]->constTree(), leaves[n]->origin(), scratch);
      for (auto it = leaves[n]->beginValueOn(); it; ++it) it.setValue(was[it.pos()]);
    });
  }
  if (isEmpty(liquid)) return true;
  addGravity(liquid.velocity, options.gravity * kick);
  liquid.leapfrogOffset += kick;
  const SolidField around = withFlows(solid, flows, phi, before, options.gravity, 0.0);
  for (const CarriedScalar& scalar : kCarriedScalars) {
    FloatGrid::Ptr& grid = liquid.*scalar.grid;
    if (grid == nullptr) continue;
    grid = makeScalar(*grid, liquid.velocity.component[0]->constTree());
    setInSources(*grid, flows, scalar.ofSource);
    extendScalar(*grid, phi, *solid.phi, kScalarLayers, solid.visibility.get());
  }
  // Viscosity acts as long as gravity does.
  const FloatGrid::Ptr viscosity =
      liquid.temperature ? viscosityOf(*liquid.temperature, options.heat.law, options.viscosity) : nullptr;
  StepReport solves;
  const bool converged = applyViscosityFor(liquid, around, kick, options, viscosity.get(), solves);
  if (report != nullptr) *report = solves;
  if (!converged) return false;
  const double dt = 1.0 / options.frameRate;
  const bool viscous = liquid.temperature != nullptr ||
                       !isNegligible(options.viscosity, dt, options.density, voxelSize(liquid));
  return applyPressure(liquid, around, {.dt = dt, .kick = kick, .viscous = viscous}, options, {}, report);
}

}  // namespace fluidtex::sim
