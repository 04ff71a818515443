#include "sim/step/apply_forces.h"

#include "sim/solids/constrain.h"
#include "sim/solids/walls.h"
#include "sim/step/keep_substep.h"
#include "sim/step/liquid_fields.h"
#include "sim/surface/open_gaps.h"
#include "sim/velocity/acceleration.h"
#include "sim/velocity/air_layers.h"
#include "sim/velocity/extrapolate.h"
#include "sim/viscosity/viscous_step.h"
#include "sim/volume/deficit_grid.h"
#include "sim/volume/volume_deficit.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace fluidtex::sim {
namespace {

// How far the expansion moves the surface in a step at most, in cells.
constexpr double kMostExpansion = 0.5;

// Open faces whose velocity is not given. At closed ones a wall holds the liquid or separates from it, and
// that force does not persist: returned in the next step, it made jets off an edge unstable. The same holds
// for open sides that are shut.
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

// Clamps a velocity's components to [-limit, limit].
void limitTo(const Velocity& velocity, float limit) {
  for (const FloatGrid::Ptr& grid : velocity.component) {
    const auto leaves = leavesOf(grid->tree());
    tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
      for (auto it = leaves[n]->beginValueOn(); it; ++it) it.setValue(std::clamp(*it, -limit, limit));
    });
  }
}

// Bounds the values beyond the narrow band, which are left over from extrapolation, by the speed that limits
// the next step.
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

// Extrapolates velocity, expansion and, where wanted, acceleration beyond the faces that the projection sets.
// arrived: the velocity before viscosity, or else before pressure.
void extrapolateAll(Liquid& liquid, Projection& projection, const SolidField& solid, double dt, bool driven,
                    Velocity arrived) {
  const FaceMasks& valid = projection.valid;
  const FaceMasks free = driven ? drivenFaces(projection, solid) : FaceMasks{};
  const bool expands = projection.expansion.component[0] != nullptr;
  liquid.acceleration = liquid.expansion = {};
  if (driven) {
    // Liquid that meets in a short step, or is very viscous, changes its velocity at once, which is no force
    // for a longer one. The next step, of twice the leapfrog offset, carries along half of this change at
    // most.
    const double longer = std::max(dt, 2.0 * liquid.leapfrogOffset);
    liquid.acceleration = accelerationBy(std::move(arrived), liquid.velocity, free, longer);
  }

  std::vector<Extrapolated> fields{{liquid.velocity, valid}};
  if (driven) fields.push_back({liquid.acceleration, free});
  if (expands) {
    // Behind a wall that leaves little of a face open the expansion could be too fast; limited, it takes
    // longer.
    limitTo(projection.expansion, static_cast<float>(kMostExpansion * voxelSize(liquid) / dt));
    fields.push_back({projection.expansion, valid});
  }
  extrapolate(fields, *liquid.phi, *solid.phi, solid.visibility.get());
  if (!expands) return;
  constrainToSolids(projection.expansion, *liquid.phi, atRest(solid), valid, *projection.separating);
  liquid.expansion = nearSurface(projection.expansion, *liquid.phi, {});
}

// Options of a projection over dt seconds in which forces act for `kick` seconds.
PressureOptions pressureOf(const Options& options, double h, double dt, double kick) {
  PressureOptions pressure;
  pressure.suction = 0.1 * options.density * options.gravity.length() * h;
  if (options.surfaceTension > 0.0) {
    // Air must open a bubble of a cell's size to get behind the liquid, against surface tension.
    pressure.suction += 2.0 * options.surfaceTension / h;
    pressure.surfaceTension = options.surfaceTension * kick / dt;
  }
  return pressure;
}

}  // namespace

bool applyViscosityFor(Liquid& liquid, const SolidField& solid, double kick, const Options& options,
                       const FloatGrid* viscosity, StepReport& report) {
  const ViscousStepReport viscous =
      applyViscousStep(liquid.velocity, *liquid.phi, solid, kick, options.density,
                       {.constant = options.viscosity, .variable = viscosity},
                       pressureOf(options, voxelSize(liquid), kick, kick));
  report.viscosity = viscous.viscosity;
  if (!viscous.viscosity.skipped) report.pressure = viscous.pressure;
  return viscous.converged();
}

bool applyPressure(Liquid& liquid, const SolidField& solid, const PressureStep& step, const Options& options,
                   Velocity arrived, StepReport* report) {
  const auto [dt, kick, viscous, driven] = step;
  PressureOptions pressure = pressureOf(options, voxelSize(liquid), dt, kick);
  pressure.keepBefore = driven && arrived.component[0] == nullptr;
  // The deficit is given back within about a frame; in less than two steps it would overshoot.
  if (liquid.deficit != nullptr && !liquid.deficit->empty())
    pressure.divergence = targetDivergence(*liquid.deficit, std::max(1.0 / options.frameRate, 2.0 * dt));
  auto& [u, v, w] = liquid.velocity.component;
  Projection projection = project(liquid.velocity, *liquid.phi, solid, dt, options.density, pressure);
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
  balanceAirLayers(liquid.velocity, projection.valid, *liquid.phi, *solid.phi, solid.visibility.get());
  constrainToSolids(liquid.velocity, *liquid.phi, solid, projection.valid, *projection.separating);
  if (viscous) stickToWalls(liquid.velocity, solid, projection.valid);
  const bool lets = driven && !projection.separating->empty();
  const ShownLiquid shown = lets ? shownAround(*projection.separating, *liquid.phi, solid) : ShownLiquid{};
  openGaps(*liquid.phi, liquid.velocity, solid, *projection.separating, options.gravity * dt, dt);
  if (lets) addChange(*liquid.deficit, shown, *liquid.phi, solid);
  const double fastest = maxAbs(liquid.velocity);
  if (!std::isfinite(fastest)) return false;
  boundInactive(liquid.velocity, static_cast<float>(fastest));
  return true;
}

}  // namespace fluidtex::sim
