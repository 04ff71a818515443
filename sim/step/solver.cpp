#include "sim/step/solver.h"

#include "sim/flows/flows.h"
#include "sim/flows/move_surface.h"
#include "sim/grid/mac_grid.h"
#include "sim/grid/require.h"
#include "sim/scalars/carried_scalar.h"
#include "sim/shapes/shape_distance.h"
#include "sim/solids/domain.h"
#include "sim/solids/solids.h"
#include "sim/step/check_options.h"
#include "sim/step/describe_liquid.h"
#include "sim/step/keep_substep.h"
#include "sim/step/pour.h"
#include "sim/step/step.h"
#include "sim/step/step_failures.h"
#include "sim/surface/level_set.h"
#include "sim/surface/poured_surface.h"
#include "sim/velocity/advect_velocity.h"
#include "sim/volume/deficit_grid.h"
#include "sim/volume/poured_volume.h"
#include "sim/volume/volume_deficit.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace fluidtex::sim {
namespace {

using DueBody = std::pair<const LiquidBody*, ShapeDistance>;

// The distance to a body and to all that are poured with it and lie within `reach` of it.
std::function<double(const Vec3d&)> withNeighbors(const ShapeDistance& body, const std::vector<DueBody>& due,
                                                  double reach) {
  openvdb::BBoxd near = body.boundsIn(kEverywhere);
  near.expand(reach);
  std::vector<ShapeDistance> shapes;
  for (const auto& [liquid, shape] : due)
    if (near.hasOverlap(shape.boundsIn(kEverywhere))) shapes.push_back(shape);
  return [shapes = std::move(shapes)](const Vec3d& x) {
    double least = kForever;
    for (const ShapeDistance& shape : shapes) least = std::min(least, shape(x));
    return least;
  };
}

// A deficit above kMostDeficit of the liquid is reported, but not one below kFewCells cells.
constexpr double kMostDeficit = 0.02, kFewCells = 8.0;
// Solids that cover no more than this share of the liquid are not reported.
constexpr double kMentioned = 1e-3;
// How often a step that fails is halved.
constexpr int kMaxHalvings = 6;
// Times closer than this share of a frame count as the same.
constexpr double kSameTime = 1e-6;

// A copy with its own phi, but without the markers, which are too large to copy.
Liquid withoutMarkers(State& state) {
  Markers markers = std::move(state.markers);
  Liquid liquid = state;
  state.markers = std::move(markers);
  liquid.markers = {};
  liquid.phi = state.phi->deepCopy();
  return liquid;
}

void store(State& state, Liquid liquid, double h) {
  static_cast<Liquid&>(state) = std::move(liquid);
  setTransforms(state, h);
}

double frameTime(const Options& options, int frame) {
  return (frame - 1) / options.frameRate;
}

// The longest step that the CFL number allows. solids: their speed; they move by at most one cell. The second
// term is what gravity adds within one cell, so that liquid at rest does not take a step of any length
// [Bridson, Fluid Simulation for Computer Graphics, sec. 3.3]. The capillary limit holds too.
double longestStep(const Options& options, double fastest, double solids) {
  const double h = options.voxelSize();
  const double speed = fastest + std::sqrt(options.gravity.length() * h);
  const double frame = 1.0 / options.frameRate;
  const double longest =
      speed > 0.0 ? std::min(frame, std::min(options.cfl, kMaxTrace - 1.0) * h / speed) : frame;
  return std::min({longest, solids > 0.0 ? h / solids : longest, capillaryStep(options)});
}

// The longest fraction 1/n of `time` that does not exceed `longest`.
double evenPart(double time, double longest) {
  return time / std::ceil(time / longest * (1.0 - kSameTime));
}

double speedOf(const SolidField& solid) {
  return solid.speed ? maxAbs(solid.speed) : 0.0;
}

// Bound of the surface's speed along an axis, m/s.
double fastest(const Liquid& liquid) {
  return maxAbs(liquid.velocity) + (liquid.expansion ? maxAbs(liquid.expansion) : 0.0);
}

}  // namespace

void checkResolution(const State& state, const Options& options) {
  const double written = state.phi->voxelSize()[0], asked = options.voxelSize();
  if (std::abs(written - asked) <= 1e-9 * asked) return;
  std::ostringstream message;
  message << "the state was made with cells of " << written << " m, the scene asks for " << asked << " m";
  throw SolverError(message.str());
}

Solver::Solver(const Options& options)
    : m_options(checked(options)), m_solids(std::make_shared<Solids>(options)) {
  const double h = options.voxelSize();
  m_state.poured.assign(options.liquid.size(), false);
  store(m_state, {makePhi(h, bandWidth(options.cfl) * h), makeVelocity(h), {}, 0, 0.0, {}}, h);
  if (options.heat.simulated) m_state.temperature = makeScalar(h, options.heat.ambient);
  if (options.mixes()) m_state.mixture = makeScalar(h, 0.0);
  prepare();
}

Solver::Solver(const Options& options, State state)
    : m_options(checked(options)), m_state(std::move(state)), m_solids(std::make_shared<Solids>(options)) {
  require(m_state.phi && m_state.velocity, "a state needs a surface and a velocity");
  checkResolution(m_state, options);
  setTransforms(m_state, options.voxelSize());
  if (options.heat.simulated && !m_state.temperature)
    throw SolverError("the state was made without heat, the scene asks for it");
  if (!options.heat.simulated) m_state.temperature = nullptr;
  if (options.mixes() && !m_state.mixture)
    throw SolverError("the state was made without a mixture of liquids, the scene asks for one");
  if (!options.mixes()) m_state.mixture = nullptr;
  m_state.poured.resize(options.liquid.size(), false);
  prepare();
}

void Solver::prepare() {
  m_flows = std::make_shared<Flows>(m_options);
  m_active = m_solids->active(m_state.time);
  m_solid = solidsAround(m_state.time, *m_state.phi);
  m_whole = liquidVolume(*m_state.phi, *m_solid) + (m_state.deficit ? totalDeficit(*m_state.deficit) : 0.0);
  m_warnings = m_solids->warnings();
  for (std::string& warning : flowWarnings(m_options, *m_solids)) m_warnings.push_back(std::move(warning));
}

std::shared_ptr<const SolidField> Solver::solidsAround(double time, const FloatGrid& phi,
                                                       const FloatGrid* more) {
  std::vector<const FloatGrid*> phis = m_flows->places();
  phis.push_back(&phi);
  if (m_state.deficit != nullptr) phis.push_back(m_state.deficit.get());
  if (more != nullptr) phis.push_back(more);
  return m_solids->around(phis, time, m_active);
}

// Pours the liquid that is due and applies changes of solids at the present time.
void Solver::applyEvents() {
  const double now = m_state.time;
  const double h = m_options.voxelSize();
  bool changed = m_state.frame == 0;
  Liquid liquid = withoutMarkers(m_state);
  std::vector<DueBody> due;
  std::vector<bool> poured = m_state.poured;
  FloatGrid dueLiquid(liquid.phi->background());
  dueLiquid.setTransform(cellTransform(h));
  for (std::size_t n = 0; n < m_options.liquid.size(); ++n) {
    const LiquidBody& body = m_options.liquid[n];
    if (m_state.poured[n] || body.from > now) continue;
    due.emplace_back(&body, ShapeDistance(body.shape, h, domainBox(m_options)));
    unite(dueLiquid, due.back().second, domainCells(m_options));
    poured[n] = true;
  }
  const auto before = m_solid;
  const auto active = m_solids->active(now);
  const bool solidsChanged = active != m_active;
  m_active = active;
  m_solid = solidsAround(now, *liquid.phi, &dueLiquid);
  if (solidsChanged) {
    changeSolids(liquid, *before, *m_solid);
    changed = true;
  }
  // Steps add what a source puts in while it runs. Without liquid there are no steps.
  const RunningFlows flows = m_flows->at(now);
  changed = changed || (isEmpty(liquid) && !flows.sources.empty());
  for (const auto& [body, shape] : due) {
    LiquidBody values = *body;
    // With the same leapfrog offset as the velocity of the liquid that is there.
    values.velocity += m_options.gravity * liquid.leapfrogOffset;
    pour(liquid, shape,
         pouredSurface(withNeighbors(shape, due, liquid.phi->background()), m_solids->distanceAt(now), h),
         values, *m_solid);
    changed = true;
  }
  if (!changed) return;
  const auto nearest = [&](const Vec3d& x) {
    double least = kForever;
    for (const auto& [body, shape] : due) least = std::min(least, shape(x));
    return least;
  };
  const auto solids = m_solids->distanceAt(now);
  MaskGrid known = beyondOwnSurface(dueLiquid, *liquid.phi, *m_solid->phi, nearest, solids);
  if (!due.empty())
    known.tree().topologyUnion(clearBehindWalls(*liquid.phi, *m_solid, nearest, solids).tree());
  // Redistancing loses thin liquid, much of it in the middle of a splash.
  const bool start = m_state.frame == 0;
  const FloatGrid::Ptr whole = liquid.phi->deepCopy();
  // Gravity acts up to the middle of the first step.
  const double first = longestStep(m_options, fastest(liquid), speedOf(*m_solid));
  double kick = liquid.leapfrogOffset > 0.0 ? 0.0 : 0.5 * evenPart(1.0 / m_options.frameRate, first);
  StepReport report;
  for (int halving = 0;; ++halving) {
    Liquid settled = liquid;
    settled.phi = liquid.phi->deepCopy();
    if (settle(settled, *m_solid, kick, m_options, &report, flows, known)) {
      liquid = std::move(settled);
      break;
    }
    if (!(kick > 0.0) || halving == kMaxHalvings) fail(now, 2.0 * kick, report);
    kick *= 0.5;
  }
  if (!start && solidsChanged) {
    const double covered = liquidVolume(*whole, *before) - liquidVolume(*whole, *m_solid);
    if (covered > kMentioned * m_whole) {
      std::ostringstream text;
      text << "at time " << now << " s a solid appears in " << covered
           << " m3 of liquid, which comes out again beside it";
      m_warnings.push_back(text.str());
    }
  }
  if (!start) {
    liquid.deficit = volumeDeficit({*whole, *liquid.phi, liquid.deficit.get()}, makeVelocity(h),
                                   {*before, *m_solid}, flows, 0.0);
  }
  if (!due.empty()) {
    const PouredLiquid bodies{dueLiquid, *whole, nearest, solids, start};
    liquid.deficit = withPoured(liquid.deficit.get(), bodies, *liquid.phi, *m_solid, flows);
  }
  store(m_state, std::move(liquid), h);
  m_state.poured = std::move(poured);
}

void Solver::tellOfDeficit() {
  if (m_toldOfDeficit || m_state.deficit == nullptr) return;
  const double deficit = totalDeficit(*m_state.deficit);
  if (std::abs(deficit) <= std::max(kMostDeficit * m_whole, kFewCells * std::pow(m_options.voxelSize(), 3)))
    return;
  m_toldOfDeficit = true;
  const Vec3d place = placeOfLargest(*m_state.deficit);
  std::ostringstream text;
  text << "at time " << m_state.time << " s the surface holds " << std::abs(deficit) << " m3 "
       << (deficit > 0.0 ? "less" : "more") << " than it should, of " << m_whole << " m3, most of it near ("
       << place[0] << ", " << place[1] << ", " << place[2] << "); "
       << (deficit > 0.0
               ? "a solid may press on liquid that has no way out, or the liquid is in drops and films "
                 "thinner than a cell"
               : "jets and drops may be thinner than a few cells")
       << "; a higher domain.resolution may help";
  m_warnings.push_back(text.str());
}

// Sets the time, which changes by no more than rounding.
void Solver::moveTime(double time) {
  if (time == m_state.time) return;
  m_state.time = time;
  m_solid = solidsAround(time, *m_state.phi);
}

void Solver::advanceTo(double time, Frame& frame, const std::function<void(double)>& report) {
  while (m_state.time < time) {
    if (m_state.phi->empty()) {
      m_state.time = time;
      m_state.leapfrogOffset = 0.0;
      m_solid = solidsAround(time, *m_state.phi);
      return;
    }
    m_solid = solidsAround(m_state.time, *m_state.phi);
    Liquid& liquid = m_state;  // a step takes its markers and acceleration
    const double remaining = time - m_state.time;
    const double speed = fastest(liquid), solids = speedOf(*m_solid);
    const double longest = longestStep(m_options, speed, solids);
    if (capillaryStep(m_options) < kShortest / m_options.frameRate) failCapillary(m_state.time);
    if (longest < kShortest / m_options.frameRate) failFast(m_state.time, speed, solids);
    // The leapfrog offset of the velocity fits a step of this length.
    const double planned = 2.0 * liquid.leapfrogOffset;
    const bool asPlanned =
        planned > 0.0 && planned <= longest * (1.0 + kSameTime) && planned <= remaining * (1.0 + kSameTime);
    double dt = asPlanned ? planned : evenPart(remaining, longest);
    bool last = dt > (1.0 - kSameTime) * remaining;
    std::shared_ptr<const SolidField> solid;

    StepReport solves;
    std::optional<Liquid> next;
    double longestNext = kForever;
    for (int halving = 0;;) {
      const double then = last ? time : m_state.time + dt;
      // Solids that come or go at that time do so after the step.
      solid = solidsAround(then, *m_state.phi);
      const double after = last ? 1.0 / m_options.frameRate : remaining - dt;
      const double nextLongest =
          longestStep(m_options, speed + m_options.gravity.length() * dt, speedOf(*solid));
      const double nextDt = std::min(longestNext, evenPart(after, nextLongest));
      next = step(liquid, {*m_solid, *solid, dt, nextDt}, m_options, &solves,
                  m_flows->at(m_state.time + 0.5 * dt));
      if (next) break;
      liquid.markers = seedMarkers(*liquid.phi, *m_solid->phi, markerSeed(m_options.seed, liquid.steps),
                                   m_solid->visibility.get());
      // Forces also act for half of the next step. Where that is much the longer one it is shortened first.
      if (nextDt <= 1.5 * dt) {
        if (halving++ == kMaxHalvings) fail(m_state.time, dt, solves);
        dt *= 0.5;
        last = false;
      }
      longestNext = dt;
    }
    frame.substeps.push_back(keepSubstep(dt, movingVelocity(liquid), *liquid.phi,
                                         {m_solid->phi.get(), solid->phi.get()}, solid->visibility));
    FrameStats& stats = frame.stats;
    stats.dtMin = stats.dtMin > 0.0 ? std::min(stats.dtMin, dt) : dt;
    stats.pressureIterations += solves.pressure.iterations;
    stats.pressureResidual = std::max(stats.pressureResidual, solves.pressure.residual);
    stats.viscosityIterations += solves.viscosity.iterations;
    store(m_state, std::move(*next), m_options.voxelSize());
    m_state.time = last ? time : m_state.time + dt;
    m_solid = solid;
    tellOfDeficit();
    if (report) report(m_state.time);
  }
}

Frame Solver::next(const std::function<void(double)>& progress) {
  Frame frame;
  frame.index = m_state.frame + 1;
  frame.time = frameTime(m_options, frame.index);
  const double start = m_state.time, length = 1.0 / m_options.frameRate, tolerance = kSameTime * length;
  const auto report = [&](double time) {
    if (progress) progress(std::clamp((time - start) / length, 0.0, 1.0));
  };
  if (m_state.frame == 0) {
    applyEvents();
  } else {
    if (m_state.phi->empty()) applyEvents();
    while (m_state.time < frame.time) {
      double event = std::min(m_solids->nextChange(m_state.time), m_flows->nextChange(m_state.time));
      for (std::size_t n = 0; n < m_options.liquid.size(); ++n) {
        if (!m_state.poured[n]) event = std::min(event, m_options.liquid[n].from);
      }
      // An event within rounding of the frame's end belongs to that frame.
      const double target = event < frame.time + tolerance ? event : frame.time;
      if (target - m_state.time > tolerance) {
        advanceTo(target, frame, report);
      } else {
        moveTime(target);
      }
      if (target == event) applyEvents();
      if (std::abs(m_state.time - frame.time) < tolerance) moveTime(std::max(m_state.time, frame.time));
    }
  }
  m_state.frame = frame.index;
  describeLiquid(frame, *m_state.phi, *m_solid);
  if (m_state.deficit) frame.stats.deficit = totalDeficit(*m_state.deficit);
  m_whole = frame.stats.volume + frame.stats.deficit;
  if (m_state.temperature) frame.fields["temperature"] = m_state.temperature;
  if (m_state.mixture) frame.fields["mixture"] = m_state.mixture;
  if (progress) progress(1.0);
  return frame;
}

}  // namespace fluidtex::sim
