// Sections C.1 and C.8 of the reference: flows without losses, whose decay is the scheme's own.
#include "tools/validation/wave_cases.h"

#include "tools/validation/order.h"
#include "tools/validation/solver_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

namespace fluidtex::validation {
namespace {

using sim::Coord;
using sim::Vec3d;
using std::numbers::pi;

// Taylor and Green's vortices without viscosity in a box with free slip, which they meet when moved by a
// quarter of a period: they should stay as they are.
Result taylorGreen(int resolution, const Progress& progress) {
  const double h = 1.0 / resolution;
  sim::Options options;
  options.size = Vec3d(1.0, 1.0, 8.0 * h);
  options.resolution = resolution;
  options.gravity = Vec3d(0.0);
  options.viscosity = 0.0;
  options.cfl = 0.5;
  options.frameRate = 10.0;
  options.liquid = {{{sim::Box{Vec3d(-1.0), Vec3d(2.0)}}}};
  const auto field = [](const Vec3d& x) {
    return Vec3d(std::sin(2.0 * pi * x[0]) * std::cos(2.0 * pi * x[1]),
                 -std::cos(2.0 * pi * x[0]) * std::sin(2.0 * pi * x[1]), 0.0);
  };
  sim::Solver solver = startedWith(options, field);
  constexpr int kFrames = 20;
  double energyMost = 0.0, energy = 0.0, mean = 0.0, square = 0.0, most = 0.0, energyFirst = 0.0;
  const auto measure = [&] {
    const sim::State& state = solver.state();
    const auto u = state.velocity.component[0]->getConstUnsafeAccessor(),
               v = state.velocity.component[1]->getConstUnsafeAccessor();
    energy = mean = square = most = 0.0;
    for (int i = 0; i < resolution; ++i) {
      for (int j = 0; j < resolution; ++j) {
        const Coord c(i, j, 4);
        const double cu = 0.5 * (u.getValue(c) + u.getValue(c.offsetBy(1, 0, 0)));
        const double cv = 0.5 * (v.getValue(c) + v.getValue(c.offsetBy(0, 1, 0)));
        // Means over two faces against means of the exact values there.
        const Vec3d x((i + 0.5) * h, (j + 0.5) * h, 0.0);
        const Vec3d exact = field(x) * std::cos(pi * h);
        const double error = std::abs(std::hypot(cu, cv) - std::hypot(exact[0], exact[1]));
        energy += cu * cu + cv * cv;
        mean += error, square += error * error, most = std::max(most, error);
      }
    }
    const double count = double(resolution) * resolution;
    mean /= count;
    square = std::sqrt(square / count);
  };
  measure();
  energyFirst = energyMost = energy;
  for (int n = 0; n < kFrames; ++n) {
    solver.next();
    measure();
    energyMost = std::max(energyMost, energy);
    if (progress) progress((n + 1.0) / kFrames);
  }
  const std::string test = "taylor_green", source = "Basilisk centred, taylor-green";
  std::optional<double> must, goal;
  std::vector<Published> rms, largest;
  const auto bars = [&](double r, double m) {
    must = 3.0 * r, goal = r;
    rms = {{r, source}};
    largest = {{m, source}};
  };
  if (resolution == 32) bars(3.26e-2, 5.84e-2);
  if (resolution == 64) bars(4.55e-3, 7.25e-3);
  if (resolution == 128) bars(5.89e-4, 9.08e-4);
  // exp(-16 pi^2 nu t) over two seconds.
  const double viscosity = -std::log(energy / energyFirst) / (16.0 * pi * pi * 2.0);
  Result result;
  result.rows = {
      {test, resolution, "error of |u|, rms, m/s", square, must, goal, false, rms, 0.0},
      {test, resolution, "error of |u|, max, m/s", most, {}, {}, false, largest, 0.0},
      {test, resolution, "energy lost, %", 100.0 * (1.0 - energy / energyFirst), {}, {}, false, {}, 0.0},
      {test,
       resolution,
       "energy gained at most, %",
       100.0 * (energyMost / energyFirst - 1.0),
       {},
       1e-6,
       false,
       {},
       0.0},
      {test, resolution, "viscosity of the scheme, m2/s", viscosity, {}, {}, false, {}, 0.0}};
  return result;
}

// Liquid at rest in the whole domain below surface(x), which lies near `depth` and is nearly level.
sim::Solver raised(sim::Options options, double depth, const std::function<double(double)>& surface) {
  options.liquid = {{{sim::HalfSpace{Vec3d(0.0, 0.0, depth), Vec3d(0.0, 0.0, 1.0)}}}};
  sim::Solver start(options);
  start.next();
  sim::State state = start.state();
  state.phi = state.phi->deepCopy();
  for (auto it = state.phi->beginValueOn(); it; ++it) {
    // The slope is at most 0.03: as good as a distance.
    const Vec3d x = state.phi->indexToWorld(it.getCoord());
    it.setValue(static_cast<float>(x[2] - surface(x[0])));
  }
  state.markers =
      sim::seedMarkers(*state.phi, *sim::makePhi(options.voxelSize(), 3.0 * options.voxelSize()), 0);
  return sim::Solver(options, std::move(state));
}

// The first standing wave in a basin 1 m long and 0.5 m deep, a hundredth of that high.
Result standingWave(int resolution, const Progress& progress) {
  constexpr double kDepth = 0.5, kAmplitude = 0.01;
  const double h = 1.0 / resolution, period = 2.0 * pi / std::sqrt(kGravity * pi * std::tanh(pi * kDepth));
  constexpr int kPerPeriod = 60, kPeriods = 3;
  sim::Options options;
  options.size = Vec3d(1.0, 8.0 * h, 0.75);
  options.resolution = resolution;
  options.viscosity = 0.0;
  options.frameRate = kPerPeriod / period;
  sim::Solver solver = raised(options, kDepth, [&](double x) {
    return kDepth + kAmplitude * std::cos(pi * std::clamp(x, 0.0, 1.0));
  });
  Curve curve{"first mode", {}, Curve::Style::line};
  // The first mode's share of the surface: the second comes and goes, as waves of finite height have it.
  const auto firstMode = [&] {
    double sum = 0.0;
    for (int i = 0; i < resolution; ++i)
      sum += 2.0 * h * std::cos(pi * (i + 0.5) * h) *
             surfaceHeight(solver.state(), i, 4, static_cast<int>(0.75 * resolution));
    return sum;
  };
  std::vector<double> amplitude{firstMode()};
  for (int n = 0; n < kPerPeriod * kPeriods + kPerPeriod / 4; ++n) {
    solver.next();
    amplitude.push_back(firstMode());
    if (progress) progress(n / (kPerPeriod * (kPeriods + 0.25)));
  }
  std::vector<double> crossings;
  double crest = 0.0;
  for (std::size_t n = 0; n < amplitude.size(); ++n) {
    const double a = amplitude[n];
    curve.points.push_back({n / double(kPerPeriod), a / kAmplitude});
    if (n == 0) continue;
    const double before = amplitude[n - 1];
    if ((a < 0.0) != (before < 0.0)) crossings.push_back((n - 1 + before / (before - a)) / kPerPeriod);
    if (n >= kPerPeriod * (kPeriods - 0.25)) crest = std::max(crest, a);
  }
  const double measured =
      crossings.size() > 1 ? 2.0 * (crossings.back() - crossings.front()) / (crossings.size() - 1.0) : 0.0;
  const double kept = crest / amplitude.front();
  const std::string test = "standing_wave";
  Result result;
  result.rows = {{test,
                  resolution,
                  "period error, %",
                  100.0 * (measured - 1.0),
                  0.5,
                  0.05,
                  false,
                  {{-0.32, "VOF guide, 64 cells a wavelength"}},
                  0.0},
                 {test,
                  resolution,
                  "energy change a period, %",
                  100.0 * (std::pow(kept, 2.0 / kPeriods) - 1.0),
                  2.0,
                  0.1,
                  false,
                  {},
                  0.0}};
  result.plots = {{fmt::format("{}_{}", test, resolution),
                   "Standing wave",
                   "periods",
                   "amplitudes",
                   false,
                   false,
                   {std::move(curve)}}};
  return result;
}

// Height of a viscous wave after each half turn: time in inviscid periods, amplitude; the reference's
// solution of Prosperetti's problem.
struct ViscousWave {
  double viscosity;
  std::array<std::array<double, 2>, 4> extrema;
};

// Half a wave 1 m long on deep water with viscosity. `resolution`: cells to the whole wave.
Result viscousWave(const ViscousWave& wave, int resolution, const Progress& progress) {
  constexpr double kDepth = 0.75, kAmplitude = 0.005;
  const double h = 1.0 / resolution, k = 2.0 * pi, period = 2.0 * pi / std::sqrt(kGravity * k);
  constexpr int kPerPeriod = 80;
  const int frames = static_cast<int>((wave.extrema.back()[0] + 0.15) * kPerPeriod);
  sim::Options options;
  options.size = Vec3d(0.5, 8.0 * h, 0.875);
  options.resolution = static_cast<int>(std::lround(0.875 * resolution));
  options.viscosity = wave.viscosity * options.density;
  options.cfl = 1.0;
  options.frameRate = kPerPeriod / period;
  const auto surface = [&](double x) { return kDepth + kAmplitude * std::cos(k * std::clamp(x, 0.0, 0.5)); };
  sim::Solver solver = raised(options, kDepth, surface);
  // The amplitude of the first mode.
  const int across = resolution / 2;
  const auto amplitude = [&] {
    double sum = 0.0;
    for (int i = 0; i < across; ++i)
      sum += (surfaceHeight(solver.state(), i, 4, options.resolution) - kDepth) * std::cos(k * (i + 0.5) * h);
    return 2.0 * sum / across / kAmplitude;
  };
  Curve found{fmt::format("{} cells", resolution), {}, Curve::Style::line},
      exact{"Prosperetti", {}, Curve::Style::marks};
  found.points.push_back({0.0, amplitude()});
  for (int n = 1; n <= frames; ++n) {
    solver.next();
    found.points.push_back({double(n) / kPerPeriod, amplitude()});
    if (progress) progress(double(n) / frames);
  }
  exact.points.push_back({0.0, 1.0});
  double worst = 0.0, late = 0.0;
  for (const auto& [time, height] : wave.extrema) {
    exact.points.push_back({time, height});
    // The extremum near that time, by a parabola through three frames.
    std::size_t best = 1;
    double most = 0.0;
    for (std::size_t n = 1; n + 1 < found.points.size(); ++n) {
      if (std::abs(found.points[n][0] - time) > 0.2 || std::abs(found.points[n][1]) < most) continue;
      if (found.points[n][1] * height > 0.0) most = std::abs(found.points[n][1]), best = n;
    }
    const double a = found.points[best - 1][1], b = found.points[best][1], c = found.points[best + 1][1];
    const double bend = a - 2.0 * b + c, shift = bend != 0.0 ? 0.5 * (a - c) / bend : 0.0;
    worst = std::max(worst, std::abs((b - 0.25 * (a - c) * shift) / height - 1.0));
    late = (found.points[best][0] + shift / kPerPeriod) / time - 1.0;
  }
  const std::string test = "standing_wave_viscous";
  return {
      {{test, resolution, "height of four extrema, worst error, %", 100.0 * worst, 2.0, 0.3, false, {}, 0.0},
       {test, resolution, "time of the fourth, error, %", 100.0 * late, 0.5, 0.05, false, {}, 0.0}},
      {{fmt::format("{}_{}", test, resolution),
        "Viscous standing wave",
        "periods",
        "amplitudes",
        false,
        false,
        {std::move(found), std::move(exact)}}}};
}

Result viscousWaves(int resolution, const Progress& progress) {
  return viscousWave({1e-2, {{{.5062, -.78265}, {1.0145, .59099}, {1.5222, -.45568}, {2.0303, .34582}}}},
                     resolution, progress);
}

}  // namespace

std::vector<Case> waveCases() {
  Case vortices{"taylor_green", "fluid", "Taylor and Green's vortices without viscosity", {32, 64, 128}, {},
                taylorGreen,    {}};
  vortices.summarize = [](const std::vector<Row>& rows) {
    return orderRows(rows, "error of |u|, rms, m/s", 2.0, {});
  };
  return {vortices,
          {"standing_wave",
           "fluid",
           "A standing wave; 2 m long, so twice as many cells to it",
           {32, 64},
           {},
           standingWave,
           {}},
          {"standing_wave_viscous",
           "fluid",
           "A standing wave with viscosity; cells to the whole wave",
           {32, 64},
           {},
           viscousWaves,
           {}}};
}

}  // namespace fluidtex::validation
