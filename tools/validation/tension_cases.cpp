// Surface tension against closed forms: Laplace's pressure jump, Rayleigh's and Lamb's frequencies.
#include "tools/validation/tension_cases.h"

#include "sim/pressure/pressure.h"
#include "sim/step/step.h"
#include "sim/surface/level_set.h"
#include "sim/surface/redistance.h"
#include "tools/validation/face_velocities.h"
#include "tools/validation/solver_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace fluidtex::validation {
namespace {

using sim::Coord;
using sim::Vec3d;
using std::numbers::pi;

constexpr double kTension = 1.0, kDropDensity = 1.0, kDropRadius = 0.25;

// Layers of a slab between two sides of symmetry, of which the middle one is measured. Near its sides the
// surface is a little off: with half as many the middle feels it.
constexpr int kLayers = 16;

// Without gravity, walls, and, where `viscosity` is 0, friction. `flat`: a slab.
sim::Options dropOptions(int resolution, bool flat, double viscosity) {
  sim::Options options;
  options.size = Vec3d(1.0, 1.0, flat ? double(kLayers) / resolution : 1.0);
  options.resolution = resolution;
  if (flat) options.sides[4] = options.sides[5] = sim::Side::symmetry;
  options.gravity = Vec3d(0.0);
  options.density = kDropDensity;
  options.viscosity = viscosity;
  options.surfaceTension = kTension;
  options.cfl = 1.0;
  return options;
}

// Liquid at rest where distance(x) is negative; the distance need not be one far from the surface.
sim::Solver shaped(const sim::Options& options, bool flat,
                   const std::function<double(const Vec3d&)>& distance) {
  sim::Options within = options;
  // A body that reaches as far as the shape, so that the band is there.
  const Vec3d middle = 0.5 * options.size;
  if (flat) {
    within.liquid = {
        {{sim::Cylinder{middle - Vec3d(0.0, 0.0, 1.0), middle + Vec3d(0.0, 0.0, 1.0), kDropRadius}}}};
  } else {
    within.liquid = {{{sim::Sphere{middle, kDropRadius}}}};
  }
  sim::Solver start(within);
  start.next();
  sim::State state = start.state();
  state.phi = state.phi->deepCopy();
  for (auto it = state.phi->beginValueOn(); it; ++it)
    it.setValue(static_cast<float>(distance(state.phi->indexToWorld(it.getCoord()))));
  const auto nothing = sim::makePhi(options.voxelSize(), 3.0 * options.voxelSize());
  sim::redistance(*state.phi, *nothing, 30);
  state.markers = sim::seedMarkers(*state.phi, *nothing, 0);
  for (auto* grid :
       {&state.velocity.component[0], &state.velocity.component[1], &state.velocity.component[2]}) {
    *grid = (*grid)->deepCopy();
    for (auto it = (*grid)->beginValueOn(); it; ++it) it.setValue(0.0f);
  }
  state.acceleration.component[0] = state.acceleration.component[1] = state.acceleration.component[2] =
      nullptr;
  state.leapfrogOffset = 0.0;
  within.liquid.clear();
  return sim::Solver(within, std::move(state));
}

// The pressure in a drop, from one projection. It should be sigma (1 / R + 1 / R), and nothing should move.
Result laplace(int resolution, const Progress&) {
  sim::Options options = dropOptions(resolution, false, 0.0);
  const double h = options.voxelSize(), dt = sim::capillaryStep(options);
  // Off the grid's symmetry.
  const Vec3d middle(0.51, 0.493, 0.504);
  const auto solid = sim::Solids(options).at(0.0);
  const sim::FloatGrid::Ptr phi = sim::makePhi(h, 4.0 * h);
  sim::unite(
      *phi, [&](const Vec3d& x) { return (x - middle).length() - kDropRadius; },
      sim::grown(solid->domain, sim::kLeafDim));
  sim::Velocity velocity = sim::makeVelocity(h, phi->constTree());
  auto& [u, v, w] = velocity.component;
  sim::PressureOptions pressure;
  pressure.surfaceTension = kTension;
  pressure.keepPressure = true;
  const sim::Projection projection = sim::project(velocity, *phi, *solid, dt, kDropDensity, pressure);
  double sum = 0.0, count = 0.0, most = 0.0;
  for (auto it = projection.pressure->cbeginValueOn(); it; ++it) {
    sum += *it;
    count += 1.0;
  }
  for (auto it = phi->cbeginValueOn(); it; ++it) {
    for (int axis = 0; axis < 3; ++axis) {
      Coord below = it.getCoord();
      below[axis] -= 1;
      if (*it >= 0.0f || phi->tree().getValue(below) >= 0.0f) continue;
      most = std::max<double>(most, std::abs(velocity.component[axis]->tree().getValue(it.getCoord())));
    }
  }
  const double jump = 2.0 * kTension / kDropRadius;
  // The velocity that the whole jump over one cell would give.
  const double unit = jump * dt / (kDropDensity * h);
  const std::string test = "laplace";
  const std::optional<double> fine = resolution < 32 ? std::nullopt : std::optional(1e-2);
  return {
      {{test, resolution, "pressure error, %", 100.0 * (sum / count / jump - 1.0), 1.0, 0.1, false, {}, 0.0},
       {test, resolution, "max |u| / (jump dt / (rho h))", most / unit, fine, 1e-4, false, {}, 0.0}},
      {}};
}

// A drop that should be at rest, for one of its slow periods.
Result staticDrop(int resolution, const Progress& progress) {
  const double laplaceNumber = 12000.0,
               viscosity = std::sqrt(kTension * kDropDensity * 2.0 * kDropRadius / laplaceNumber);
  sim::Options options = dropOptions(resolution, false, viscosity);
  const double slow = std::sqrt(kDropDensity * std::pow(2.0 * kDropRadius, 3) / kTension);
  constexpr int kFrames = 20;
  options.frameRate = kFrames / slow;
  const Vec3d middle = 0.5 * options.size;
  options.liquid = {{{sim::Sphere{middle, kDropRadius}}}};
  sim::Solver solver(options);
  const double before = solver.next().stats.volume;
  double most = 0.0, after = 0.0, last = 0.0;
  for (int n = 0; n < kFrames; ++n) {
    const sim::Frame frame = solver.next();
    after = frame.stats.volume;
    last = fastestOf(solver.state());
    most = std::max(most, last);
    if (progress) progress((n + 1.0) / kFrames);
  }
  const std::string test = "static_drop";
  Result result;
  result.rows = {
      {test, resolution, "max |u| mu / sigma", most * viscosity / kTension, 1e-4, 1e-6, false, {}, 0.0},
      {test, resolution, "at the end", last * viscosity / kTension, {}, {}, false, {}, 0.0},
      {test, resolution, "volume change, %", 100.0 * (after / before - 1.0), 0.1, {}, false, {}, 0.0}};
  return result;
}

// Twice the drop's quadrupole about its first (flat) or last axis over that of a sphere.
double stretch(const sim::State& state, int resolution, bool flat) {
  const double h = state.phi->voxelSize()[0];
  const auto phi = state.phi->getConstUnsafeAccessor();
  double sum = 0.0, size = 0.0;
  for (int i = 0; i < resolution; ++i) {
    for (int j = 0; j < resolution; ++j) {
      for (int k = flat ? kLayers / 2 : 0; k < (flat ? kLayers / 2 + 1 : resolution); ++k) {
        const double wet = std::clamp(0.5 - phi.getValue(Coord(i, j, k)) / h, 0.0, 1.0);
        const double x = (i + 0.5) * h - 0.5, y = (j + 0.5) * h - 0.5, z = (k + 0.5) * h - 0.5;
        sum += wet * (flat ? x * x - y * y : z * z - 0.5 * (x * x + y * y));
        size += wet * (flat ? x * x + y * y : x * x + y * y + z * z);
      }
    }
  }
  return sum / size;
}

Result swingingDrop(bool flat, int resolution, const Progress& progress) {
  constexpr double kAmplitude = 0.05;
  sim::Options options = dropOptions(resolution, flat, 0.0);
  const double square =
      (flat ? 6.0 : 8.0) * kTension / (kDropDensity * kDropRadius * kDropRadius * kDropRadius);
  const double period = 2.0 * pi / std::sqrt(square);
  constexpr int kPerPeriod = 40, kPeriods = 3;
  options.frameRate = kPerPeriod / period;
  const Vec3d middle = 0.5 * options.size;
  sim::Solver solver = shaped(options, flat, [&](const Vec3d& x) {
    const Vec3d from = x - middle;
    if (flat) {
      const double r = std::hypot(from[0], from[1]), c = r > 0.0 ? from[0] / r : 0.0;
      return r - kDropRadius * (1.0 + kAmplitude * (2.0 * c * c - 1.0) - 0.25 * kAmplitude * kAmplitude);
    }
    const double r = from.length(), c = r > 0.0 ? from[2] / r : 0.0;
    return r - kDropRadius * (1.0 + kAmplitude * 0.5 * (3.0 * c * c - 1.0) - 0.2 * kAmplitude * kAmplitude);
  });
  const auto moment = [&] { return stretch(solver.state(), resolution, flat); };
  Curve curve{fmt::format("{} cells", resolution), {}, Curve::Style::line};
  std::vector<double> amplitude{moment()};
  double before = 0.0, worst = 0.0;
  for (int n = 0; n < kPerPeriod * kPeriods + kPerPeriod / 4; ++n) {
    const sim::Frame frame = solver.next();
    if (n == 0) before = frame.stats.volume;
    worst = std::max(worst, std::abs(frame.stats.volume / before - 1.0));
    amplitude.push_back(moment());
    if (progress) progress(n / (kPerPeriod * (kPeriods + 0.25)));
  }
  std::vector<double> crossings;
  double crest = 0.0;
  for (std::size_t n = 0; n < amplitude.size(); ++n) {
    const double a = amplitude[n];
    curve.points.push_back({n / double(kPerPeriod), a / amplitude.front()});
    if (n > 0 && (a < 0.0) != (amplitude[n - 1] < 0.0))
      crossings.push_back((n - 1 + amplitude[n - 1] / (amplitude[n - 1] - a)) / kPerPeriod);
    if (n >= kPerPeriod * (kPeriods - 0.25)) crest = std::max(crest, a);
  }
  const double measured =
      crossings.size() > 1 ? 2.0 * (crossings.back() - crossings.front()) / (crossings.size() - 1.0) : 0.0;
  const std::string test = flat ? "swinging_drop_2d" : "swinging_drop";
  std::vector<Published> others;
  if (flat && resolution == 32) others = {{0.85, "Basilisk oscillation, 12.8 cells a diameter"}};
  if (flat && resolution == 64) others = {{0.0, "Basilisk oscillation, 25.6 cells a diameter"}};
  Result result;
  result.rows = {
      {test, resolution, "period error, %", 100.0 * (measured - 1.0), 2.0, 0.5, false, others, 0.0},
      {test,
       resolution,
       "amplitude kept a period, %",
       100.0 * std::pow(crest / amplitude.front(), 1.0 / kPeriods),
       {},
       {},
       false,
       {},
       0.0},
      {test, resolution, "volume change at most, %", 100.0 * worst, 1.0, 0.1, false, {}, 0.0}};
  result.plots = {{fmt::format("{}_{}", test, resolution),
                   "A drop that swings",
                   "periods",
                   "amplitude",
                   false,
                   false,
                   {std::move(curve)}}};
  return result;
}

Result swingingBall(int resolution, const Progress& progress) {
  return swingingDrop(false, resolution, progress);
}

Result swingingDisk(int resolution, const Progress& progress) {
  return swingingDrop(true, resolution, progress);
}

}  // namespace

std::vector<Case> tensionCases() {
  return {
      {"laplace", "fluid", "The pressure in a drop", {16, 32, 64}, {32}, laplace, {}},
      {"static_drop", "fluid", "A drop held by surface tension", {16, 32, 64}, {}, staticDrop, {}},
      {"swinging_drop", "fluid", "A drop that swings by surface tension", {16, 32, 64}, {}, swingingBall, {}},
      {"swinging_drop_2d", "fluid", "The same between two plates", {16, 32, 64}, {}, swingingDisk, {}}};
}

}  // namespace fluidtex::validation
