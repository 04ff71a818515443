#include "sim/step/step.h"

#include "sim/flows/move_surface.h"
#include "sim/grid/leaf_table.h"
#include "sim/grid/require.h"
#include "sim/heat/advect_temperature.h"
#include "sim/heat/heat.h"
#include "sim/solids/constrain.h"
#include "sim/solids/solid_layers.h"
#include "sim/solids/walls.h"
#include "sim/step/keep_substep.h"
#include "sim/surface/level_set.h"
#include "sim/surface/open_gaps.h"
#include "sim/surface/settle_surface.h"
#include "sim/velocity/acceleration.h"
#include "sim/velocity/advect_velocity.h"
#include "sim/velocity/air_layers.h"
#include "sim/velocity/extrapolate.h"
#include "sim/viscosity/viscous_step.h"
#include "sim/volume/regained_surface.h"
#include "sim/volume/volume_deficit.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fluidtex::sim {
namespace {

// Layers of voxels outside the domain in which phi and velocity may have leaves.
constexpr int kMargin = kLeafDim;

// Cells beyond the liquid that get its temperature: what is newly wet in a step lies within.
constexpr int kTemperatureLayers = 6;

// How far the surface goes at most in a step to give back what is owed, in cells.
constexpr double kMostExpansion = 0.5;

double voxelSize(const Liquid& liquid) {
  return liquid.phi->voxelSize()[0];
}

// Zero velocity with a topology for this phi: liquid, the band around it, and the first layers of solids
// there.
Velocity velocityFor(const FloatGrid& phi, const SolidField& solid) {
  const auto origins = wetLeaves(phi, grown(solid.domain, kMargin));
  FloatTree topology(0.0f);
  for (const Coord& origin : origins) topology.touchLeaf(origin);
  const auto leaves = leavesOf(topology);
  const float deepest = -kSolidLayers * static_cast<float>(phi.voxelSize()[0]);
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    float phiScratch[kLeafSize], solidScratch[kLeafSize];
    const float* p = leafValues(phi.constTree(), leaves[n]->origin(), phiScratch);
    const float* s = leafValues(solid.phi->constTree(), leaves[n]->origin(), solidScratch);
    for (int i = 0; i < kLeafSize; ++i)
      leaves[n]->setActiveState(i, p[i] < phi.background() && s[i] > deepest);
  });
  return makeVelocity(phi.voxelSize()[0], topology);
}

void addGravity(Velocity& velocity, const Vec3d& change) {
  for (int a = 0; a < 3; ++a) {
    const float add = static_cast<float>(change[a]);
    const auto leaves = leavesOf(velocity.component[a]->tree());
    if (add == 0.0f) continue;
    tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
      for (auto it = leaves[n]->beginValueOn(); it; ++it) it.setValue(*it + add);
    });
  }
}

// Liquid that comes out of sources has their temperature.
void setSourceTemperature(FloatGrid& temperature, const RunningFlows& flows) {
  for (const auto& [source, factor] : flows.sources) {
    for (FloatLeaf* leaf : leavesOf(temperature.tree())) {
      float scratch[kLeafSize];
      const float* phi = leafValues(source->phi->constTree(), leaf->origin(), scratch);
      for (int i = 0; i < kLeafSize; ++i) {
        if (phi[i] < 0.0f) leaf->setValueOnly(i, static_cast<float>(source->temperature));
      }
    }
  }
}

// Air around sources that only keep full is at rest: what is filled up there is new, and has not fallen with
// what it takes the place of. phi: the liquid's.
void restBesideSources(Velocity& velocity, const FloatGrid& phi, const RunningFlows& flows) {
  const float reach = static_cast<float>(kMaxTrace * phi.voxelSize()[0]);
  for (const auto& [source, factor] : flows.sources) {
    if (source->velocity[0] != nullptr) continue;
    const FloatGrid& shape = *source->phi;
    for (int axis = 0; axis < 3; ++axis) {
      const auto leaves = leavesOf(velocity.component[axis]->tree());
      tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
        const auto liquid = phi.getConstAccessor(), distance = shape.getConstAccessor();
        for (auto it = leaves[n]->beginValueOn(); it; ++it) {
          const Coord above = it.getCoord();
          Coord below = above;
          below[axis] -= 1;
          if (std::min(distance.getValue(above), distance.getValue(below)) < reach &&
              liquid.getValue(above) >= 0.0f && liquid.getValue(below) >= 0.0f)
            it.setValue(0.0f);
        }
      });
    }
  }
}

// Carries the velocity over into `next`, whose surface and leaves are known. Forces act along the path, half
// of them those of its start; what follows in the step adds them as they are at its end. Half the difference
// makes the step second order in time.
void carryVelocity(const Liquid& liquid, Liquid& next, const SolidField& solid, const RunningFlows& flows,
                   double dt) {
  const bool before = liquid.acceleration.component[0] != nullptr;
  Velocity carried = before ? plus(liquid.velocity, liquid.acceleration, 0.5 * dt) : copyOf(liquid.velocity);
  extendLinearly(carried, *liquid.phi);
  restBesideSources(carried, *liquid.phi, flows);
  advectVelocity(liquid.velocity, carried, next.velocity, *next.phi, *solid.phi, dt, solid.visibility.get());
  if (before) next.velocity = plus(next.velocity, liquid.acceleration, -0.5 * dt);
}

// Carries the temperature over into `next`, whose surface and leaves are known, and conducts it. False where
// that fails.
bool moveHeat(const Liquid& liquid, Liquid& next, const SolidField& solid, const RunningFlows& flows,
              double dt, const Options& options) {
  next.temperature = advectTemperature(*liquid.temperature, movingVelocity(liquid),
                                       next.velocity.component[0]->constTree(), *next.phi, solid, dt);
  setSourceTemperature(*next.temperature, flows);
  const bool done = conductHeat(*next.temperature, *next.phi, solid, dt, options.density, options.heat);
  extendTemperature(*next.temperature, *next.phi, *solid.phi, kTemperatureLayers);
  return done;
}

// Open faces whose velocity is not given. At closed ones a wall holds the liquid or lets go of it, which is
// no force that goes on: what it did in one step, given back in the next, made jets off an edge run away. As
// little is what shuts an open side.
FaceMasks drivenFaces(const Projection& projection, const SolidField& solid) {
  const FaceMasks& valid = projection.valid;
  FaceMasks faces;
  for (int a = 0; a < 3; ++a) {
    faces.component[a] = valid[a].deepCopy();
    faces.component[a]->tree().topologyIntersection(solid.open[a].constTree());
    if (solid.given) faces.component[a]->tree().topologyDifference(solid.given[a].constTree());
  }
  for (const auto& [axis, at] : projection.shut) faces.component[axis]->tree().setValueOff(at);
  return faces;
}

// Brings a velocity's components within -limit to limit.
void limitTo(const Velocity& velocity, float limit) {
  for (const FloatGrid::Ptr& grid : velocity.component) {
    const auto leaves = leavesOf(grid->tree());
    tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
      for (auto it = leaves[n]->beginValueOn(); it; ++it) it.setValue(std::clamp(*it, -limit, limit));
    });
  }
}

// Beyond the band values are left over from extrapolation. None may lead farther than what the length of the
// next step goes by.
void boundInactive(const Velocity& velocity, float fastest) {
  for (const FloatGrid::Ptr& grid : velocity.component) {
    const auto leaves = leavesOf(grid->tree());
    tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
      float* values = leaves[n]->buffer().data();
      for (int i = 0; i < kLeafSize; ++i)
        if (!leaves[n]->isValueOn(i)) values[i] = std::clamp(values[i], -fastest, fastest);
    });
  }
}

// Velocity, swelling and, where that is wanted, acceleration beyond the faces whose values the projection
// knows. arrived: the velocity before friction or else before pressure.
void extrapolateAll(Liquid& liquid, Projection& projection, const SolidField& solid, double dt, bool driven,
                    Velocity arrived) {
  const FaceMasks& valid = projection.valid;
  const FaceMasks free = driven ? drivenFaces(projection, solid) : FaceMasks{};
  const bool expands = projection.expansion.component[0] != nullptr;
  liquid.acceleration = liquid.expansion = {};
  if (driven) liquid.acceleration = accelerationBy(std::move(arrived), liquid.velocity, free, dt);

  std::vector<Extrapolated> fields{{liquid.velocity, valid}};
  if (driven) fields.push_back({liquid.acceleration, free});
  if (expands) {
    // Where a wall leaves little of a face open, what grows behind it would shoot out; it can wait.
    limitTo(projection.expansion, static_cast<float>(kMostExpansion * voxelSize(liquid) / dt));
    fields.push_back({projection.expansion, valid});
  }
  extrapolate(fields, *liquid.phi, *solid.phi);
  if (!expands) return;
  const auto& [u, v, w] = projection.expansion.component;
  constrainToSolids(*u, *v, *w, *liquid.phi, atRest(solid), valid, *projection.separating);
  liquid.expansion = nearSurface(projection.expansion, *liquid.phi, {});
}

// Of a projection over dt seconds in which forces act for `kick` seconds.
PressureOptions pressureOf(const Options& options, double h, double dt, double kick) {
  PressureOptions pressure;
  pressure.suction = 0.1 * options.density * options.gravity.length() * h;
  if (options.surfaceTension > 0.0) {
    // Air must open a bubble of a cell's size to get behind the liquid.
    pressure.suction += 2.0 * options.surfaceTension / h;
    pressure.surfaceTension = options.surfaceTension * kick / dt;
  }
  return pressure;
}

// Friction acts for `kick` seconds, as forces do. False where a solve does not converge.
bool rub(Liquid& liquid, const SolidField& solid, double kick, const Options& options,
         const FloatGrid* viscosity, StepReport& report) {
  const ViscousStepReport friction =
      applyViscousStep(liquid.velocity, *liquid.phi, solid, kick, options.density,
                       {.constant = options.viscosity, .variable = viscosity},
                       pressureOf(options, voxelSize(liquid), kick, kick));
  report.viscosity = friction.viscosity;
  if (!friction.viscosity.skipped) report.pressure = friction.pressure;
  return friction.converged();
}

// kick: how long forces act, in seconds. viscous: whether friction is felt, so that liquid can stick to
// walls. driven: whether the acceleration is wanted; arrived: the velocity before friction, null grids where
// there was none.
bool project(Liquid& liquid, const SolidField& solid, double dt, double kick, const Options& options,
             bool viscous, bool driven, Velocity arrived, StepReport* report) {
  PressureOptions pressure = pressureOf(options, voxelSize(liquid), dt, kick);
  pressure.keepBefore = driven && arrived.component[0] == nullptr;
  // Within about a frame; in less than two steps it would overshoot.
  if (liquid.deficit != nullptr && !liquid.deficit->empty())
    pressure.growth = growthOf(*liquid.deficit, std::max(1.0 / options.frameRate, 2.0 * dt));
  auto& [u, v, w] = liquid.velocity.component;
  Projection projection = project(*u, *v, *w, *liquid.phi, solid, dt, options.density, pressure);
  if (report != nullptr) {
    projection.report.iterations += report->pressure.iterations;
    report->pressure = projection.report;
  }
  if (!projection.report.converged) return false;
  uniteTopology(liquid.velocity);  // the projection may have added faces to one component
  for (const FloatGrid::Ptr& grid : projection.expansion.component) {
    if (grid != nullptr) grid->topologyUnion(*u);
  }
  if (pressure.keepBefore) arrived = std::move(projection.before);
  extrapolateAll(liquid, projection, solid, dt, driven, std::move(arrived));
  balanceAirLayers(liquid.velocity, projection.valid, *liquid.phi, *solid.phi);
  constrainToSolids(*u, *v, *w, *liquid.phi, solid, projection.valid, *projection.separating);
  if (viscous) stickToWalls(liquid.velocity, solid, projection.valid);
  const bool lets = driven && !projection.separating->empty();
  const ShownLiquid shown = lets ? shownAround(*projection.separating, *liquid.phi, solid) : ShownLiquid{};
  openGaps(*liquid.phi, liquid.velocity, solid, *projection.separating, options.gravity * dt, dt);
  if (lets) oweChange(*liquid.deficit, shown, *liquid.phi, solid);
  const double fastest = maxAbs(liquid.velocity);
  if (!std::isfinite(fastest)) return false;
  boundInactive(liquid.velocity, static_cast<float>(fastest));
  return true;
}

// Markers beyond a side of the domain that is not closed are gone, and hold no film there.
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

std::optional<Liquid> step(Liquid& liquid, const SolidField& before, const SolidField& solid, double dt,
                           double nextDt, const Options& options, StepReport* report,
                           const RunningFlows& flows) {
  require(dt > 0.0 && nextDt >= 0.0, "step: the time step must be positive, the next one not negative");
  const double kick = std::max(0.0, dt - liquid.leapfrogOffset + 0.5 * nextDt);
  Liquid next{liquid.phi->deepCopy(), {}, {}, liquid.steps + 1, liquid.leapfrogOffset - dt + kick, {}};
  next.markers = std::move(liquid.markers);
  liquid.markers = {};
  {
    const Velocity moving = movingVelocity(liquid);
    moveSurface(*next.phi, next.markers, moving, solid, dt, markerSeed(options.seed, next.steps), flows,
                before.phi != solid.phi && solid.speed ? before.phi.get() : nullptr);
    dropBeyond(next.markers, solid);
    next.deficit =
        volumeDeficit(*liquid.phi, *next.phi, liquid.deficit.get(), moving, before, solid, flows, dt);
    withdrawSurface(*next.phi, next.markers, *next.deficit, solid);
    regainSurface(*next.phi, next.markers, *next.deficit, solid);
  }
  next.velocity = velocityFor(*next.phi, solid);
  carryVelocity(liquid, next, solid, flows, dt);
  liquid.acceleration = {};
  addGravity(next.velocity, options.gravity * kick);
  const SolidField around = withFlows(solid, flows, *next.phi, liquid.velocity, options.gravity, dt);
  StepReport solves;
  solves.pressure.converged = true;
  FloatGrid::Ptr viscosity;
  if (liquid.temperature) {
    solves.heatConverged = moveHeat(liquid, next, around, flows, dt, options);
    viscosity = viscosityOf(*next.temperature, options.heat.law, options.viscosity);
  }
  const bool frictionless =
      viscosity == nullptr && isNegligible(options.viscosity, kick, options.density, voxelSize(next));
  Velocity arrived;
  if (!frictionless) arrived = copyOf(next.velocity);
  const bool rubbed = solves.heatConverged && rub(next, around, kick, options, viscosity.get(), solves);
  if (report != nullptr) *report = solves;
  if (!rubbed) return std::nullopt;
  if (!project(next, around, dt, kick, options, !solves.viscosity.skipped, true, std::move(arrived), report))
    return std::nullopt;
  if (!anyInside(*next.phi)) {
    // What is left of the band has no surface that could renew it.
    next.phi->clear();
    next.markers.clear();
    next.acceleration = next.expansion = {};
  }
  return next;
}

void pour(Liquid& liquid, const ShapeDistance& body, const std::function<double(const Vec3d&)>& surface,
          const Vec3d& velocity, double temperature, const SolidField& solid) {
  unite(*liquid.phi, body, solid.domain, surface);
  const Velocity before = liquid.velocity;
  liquid.velocity = velocityFor(*liquid.phi, solid);
  if (liquid.temperature) {
    liquid.temperature = makeTemperature(*liquid.temperature, liquid.velocity.component[0]->constTree());
    heatBody(*liquid.temperature, body, temperature);
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
        const bool inBody = body(grid.indexToWorld(it.getCoord())) < 0.5 * h;
        it.setValue(inBody ? static_cast<float>(velocity[a]) : was[it.pos()]);
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
            const RunningFlows& flows) {
  FloatGrid& phi = *liquid.phi;
  applyFlows(phi, liquid.markers, flows);
  settleSurface(phi, solid);
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
  if (liquid.temperature) {
    liquid.temperature = makeTemperature(*liquid.temperature, liquid.velocity.component[0]->constTree());
    setSourceTemperature(*liquid.temperature, flows);
    extendTemperature(*liquid.temperature, phi, *solid.phi, kTemperatureLayers);
  }
  // Friction acts as long as gravity does.
  const FloatGrid::Ptr viscosity =
      liquid.temperature ? viscosityOf(*liquid.temperature, options.heat.law, options.viscosity) : nullptr;
  StepReport solves;
  const bool rubbed = rub(liquid, around, kick, options, viscosity.get(), solves);
  if (report != nullptr) *report = solves;
  if (!rubbed) return false;
  const double dt = 1.0 / options.frameRate;
  const bool viscous = liquid.temperature != nullptr ||
                       !isNegligible(options.viscosity, dt, options.density, voxelSize(liquid));
  return project(liquid, around, dt, kick, options, viscous, false, {}, report);
}

}  // namespace fluidtex::sim
