#include "sim/step/step.h"

#include "sim/flows/move_surface.h"
#include "sim/grid/leaf_table.h"
#include "sim/grid/require.h"
#include "sim/heat/heat.h"
#include "sim/scalars/advect_scalar.h"
#include "sim/scalars/carried_scalar.h"
#include "sim/step/liquid_fields.h"
#include "sim/velocity/acceleration.h"
#include "sim/velocity/advect_velocity.h"
#include "sim/velocity/air_layers.h"
#include "sim/velocity/extrapolate.h"
#include "sim/volume/regained_surface.h"
#include "sim/volume/volume_deficit.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fluidtex::sim {
namespace {

// Liquid that refills a source is new, and has not moved with what it replaces: the air in the cells that the
// source keeps full in part has the source's velocity, and the air around sources of velocity 0, from which
// liquid falls, is at rest. phi: the liquid's.
void flowFromSources(Velocity& velocity, const FloatGrid& phi, const RunningFlows& flows) {
  const auto h = static_cast<float>(phi.voxelSize()[0]);
  for (const auto& [source, factor] : flows.sources) {
    const FloatGrid& shape = *source->phi;
    const float reach = source->velocity[0] != nullptr ? 0.5f * h : static_cast<float>(kMaxTrace) * h;
    for (int axis = 0; axis < 3; ++axis) {
      const auto speed = static_cast<float>(factor * source->speed[axis]);
      const auto leaves = leavesOf(velocity.component[axis]->tree());
      tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
        const auto liquid = phi.getConstAccessor(), distance = shape.getConstAccessor();
        for (auto it = leaves[n]->beginValueOn(); it; ++it) {
          const Coord above = it.getCoord();
          Coord below = above;
          below[axis] -= 1;
          if (std::min(distance.getValue(above), distance.getValue(below)) < reach &&
              liquid.getValue(above) >= 0.0f && liquid.getValue(below) >= 0.0f)
            it.setValue(speed);
        }
      });
    }
  }
}

// Advects the velocity into `next`, whose surface and leaves are known. Half of the forces act along the path
// with their values at its start; the later stages of the step add them with their values at its end. Half
// the difference makes the step second-order in time.
void carryVelocity(const Liquid& liquid, Liquid& next, const SolidField& solid, const RunningFlows& flows,
                   double dt) {
  const bool before = liquid.acceleration.component[0] != nullptr;
  Velocity carried = before ? plus(liquid.velocity, liquid.acceleration, 0.5 * dt) : copyOf(liquid.velocity);
  extendLinearly(carried, *liquid.phi, solid.visibility.get());
  flowFromSources(carried, *liquid.phi, flows);
  advectVelocity(liquid.velocity, carried, next.velocity, *next.phi, *solid.phi, dt, solid.visibility.get());
  if (before) next.velocity = plus(next.velocity, liquid.acceleration, -0.5 * dt);
}

// Advects the scalars into `next`, whose surface and leaves are known.
void carryScalars(const Liquid& liquid, Liquid& next, const SolidField& solid, const RunningFlows& flows,
                  double dt) {
  for (const CarriedScalar& scalar : kCarriedScalars) {
    const FloatGrid::Ptr& before = liquid.*scalar.grid;
    if (before == nullptr) continue;
    const FloatGrid::Ptr after = advectScalar(*before, movingVelocity(liquid),
                                              next.velocity.component[0]->constTree(), *next.phi, solid, dt);
    setInSources(*after, flows, scalar.ofSource);
    next.*scalar.grid = after;
  }
}

void extendScalars(Liquid& liquid, const SolidField& solid) {
  for (const CarriedScalar& scalar : kCarriedScalars)
    if (liquid.*scalar.grid != nullptr)
      extendScalar(*(liquid.*scalar.grid), *liquid.phi, *solid.phi, kScalarLayers, solid.visibility.get());
}

// Drops markers beyond sides of the domain that are not closed, so that they hold no film there.
void dropBeyond(Markers& markers, const SolidField& solid) {
  for (int side = 0; side < 6; ++side) {
    if (isClosed(solid.sides[side])) continue;
    const int axis = side / 2;
    for (MarkerBlock& block : markers) {
      const int first = block.origin[axis];
      const int low = solid.domain.min()[axis], high = solid.domain.max()[axis] + 1;
      if (first >= low && first + kLeafDim < high) continue;
      // Marker positions are measured from the centre of the block's first cell.
      std::erase_if(block.markers, [&](const Marker& m) {
        const double at = first + 0.5 + std::array{m.x, m.y, m.z}[axis];
        return side % 2 == 0 ? at < low : at > high;
      });
    }
  }
  std::erase_if(markers, [](const MarkerBlock& block) { return block.markers.empty(); });
}

bool anyInside(const FloatGrid& phi) {
  const auto leaves = leavesOf(phi.constTree());
  const auto inside = [](float value) { return value < 0.0f; };
  if (std::any_of(leaves.begin(), leaves.end(), [&](const FloatLeaf* leaf) {
        return std::any_of(leaf->buffer().data(), leaf->buffer().data() + kLeafSize, inside);
      }))
    return true;
  auto tile = phi.constTree().cbeginValueAll();
  tile.setMaxDepth(FloatTree::ValueAllCIter::LEAF_DEPTH - 1);
  for (; tile; ++tile)
    if (inside(*tile)) return true;
  return false;
}

}  // namespace

double capillaryStep(const Options& options) {
  if (!(options.surfaceTension > 0.0)) return kForever;
  const double h = options.voxelSize();
  return std::sqrt(options.density * h * h * h / (4.0 * std::numbers::pi * options.surfaceTension));
}

std::optional<Liquid> step(Liquid& liquid, const TimeStep& times, const Options& options, StepReport* report,
                           const RunningFlows& flows) {
  const auto& [before, solid, dt, nextDt] = times;
  require(dt > 0.0 && nextDt >= 0.0, "step: the time step must be positive, the next one not negative");
  const double kick = std::max(0.0, dt - liquid.leapfrogOffset + 0.5 * nextDt);
  Liquid next{liquid.phi->deepCopy(), {}, {}, liquid.steps + 1, liquid.leapfrogOffset - dt + kick, {}};
  next.markers = std::move(liquid.markers);
  liquid.markers = {};
  {
    const Velocity moving = movingVelocity(liquid);
    moveSurface(*next.phi, next.markers,
                {moving, solid, dt, markerSeed(options.seed, next.steps),
                 before.phi != solid.phi && solid.speed ? before.phi.get() : nullptr},
                flows);
    dropBeyond(next.markers, solid);
    next.deficit =
        volumeDeficit({*liquid.phi, *next.phi, liquid.deficit.get()}, moving, {before, solid}, flows, dt);
    withdrawSurface(*next.phi, next.markers, *next.deficit, solid);
    regainSurface(*next.phi, next.markers, *next.deficit, solid, flows);
  }
  next.velocity = velocityFor(*next.phi, solid);
  carryVelocity(liquid, next, solid, flows, dt);
  liquid.acceleration = {};
  addGravity(next.velocity, options.gravity * kick);
  const SolidField around = withFlows(solid, flows, *next.phi, liquid.velocity, options.gravity, dt);
  StepReport solves;
  solves.pressure.converged = true;
  FloatGrid::Ptr viscosity;
  carryScalars(liquid, next, around, flows, dt);
  if (next.temperature)
    solves.heatConverged =
        conductHeat(*next.temperature, *next.phi, around, dt, options.density, options.heat);
  extendScalars(next, around);
  if (next.temperature) viscosity = viscosityOf(*next.temperature, options.heat.law, options.viscosity);
  const bool inviscid =
      viscosity == nullptr && isNegligible(options.viscosity, kick, options.density, voxelSize(next));
  Velocity arrived;
  if (!inviscid) arrived = copyOf(next.velocity);
  const bool converged =
      solves.heatConverged && applyViscosityFor(next, around, kick, options, viscosity.get(), solves);
  if (report != nullptr) *report = solves;
  if (!converged) return std::nullopt;
  const PressureStep pressure{.dt = dt, .kick = kick, .viscous = !solves.viscosity.skipped, .driven = true};
  if (!applyPressure(next, around, pressure, options, std::move(arrived), report)) return std::nullopt;
  if (!anyInside(*next.phi)) {
    // The rest of the narrow band has no surface to be updated from.
    next.phi->clear();
    next.markers.clear();
    next.acceleration = next.expansion = {};
  }
  return next;
}

}  // namespace fluidtex::sim
