// Kleefsman, Fekken, Veldman, Iwanowski and Buchner, "A volume-of-fluid based simulation method for wave
// impact problems", 2005. One phase only: no air cushions the impact.
#include "tools/validation/marin_case.h"

#include "sim/pressure/pressure.h"
#include "sim/solids/solids.h"
#include "sim/velocity/advect_velocity.h"
#include "tools/validation/solver_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace fluidtex::validation {
namespace {

using sim::Coord;
using sim::Vec3d;

// Samples of the experiment's record: time (s), height of the water (m) at x = 0.992 m and x = 2.638 m.
constexpr double kHeights[][3] = {
    {0.000, 0.0005, 0.5467}, {0.100, 0.0005, 0.5336}, {0.150, 0.0005, 0.5223}, {0.200, 0.0007, 0.5110},
    {0.250, 0.0007, 0.5003}, {0.300, 0.0008, 0.4861}, {0.350, 0.0015, 0.4727}, {0.400, 0.0464, 0.4595},
    {0.450, 0.0771, 0.4430}, {0.500, 0.0988, 0.4261}, {0.550, 0.1163, 0.4112}, {0.600, 0.1195, 0.3947},
    {0.910, 0.1665, 0.2995}, {0.950, 0.1741, 0.2903}, {1.000, 0.1791, 0.2789}, {1.050, 0.1847, 0.2661},
    {1.100, 0.1855, 0.2537}, {1.850, 0.3033, 0.1421}, {1.900, 0.2884, 0.1377}, {1.950, 0.2945, 0.1339},
    {2.000, 0.2870, 0.1295}, {2.050, 0.3031, 0.1271}, {3.802, 0.1689, 0.3938}, {3.850, 0.1619, 0.3984},
    {3.900, 0.1535, 0.3833}, {3.950, 0.1473, 0.3579}, {4.000, 0.1355, 0.3317}, {4.822, 0.2506, 0.2643},
    {4.850, 0.2565, 0.2602}, {4.900, 0.2534, 0.2515}, {4.950, 0.2517, 0.2414}, {5.000, 0.2519, 0.2332}};
// Of the pressure on the box' front, 0.061 m above the floor: time (s), Pa.
constexpr double kPressure[][2] = {
    {0.4020, -70.3},  {0.4040, 74.0},   {0.4060, -81.8},  {0.4080, -8.3},   {0.4100, 520.6},
    {0.4110, 2003.3}, {0.4120, 2907.0}, {0.4140, 3542.9}, {0.4150, 3934.9}, {0.4180, 4309.3},
    {0.4200, 5616.5}, {0.4240, 7194.3}, {0.4260, 8127.5}, {0.4280, 7834.8}, {0.4300, 7363.4},
    {0.4350, 7494.8}, {0.4400, 7772.7}, {0.4450, 7446.1}, {0.4500, 7396.9}, {0.4550, 7467.7},
    {0.4590, 7327.5}, {0.4650, 7005.9}, {0.4700, 6853.9}, {0.4750, 6901.1}, {0.4800, 6668.7}};
// Water is 1 cm high at x = 0.992 m at this time, s; highest again at x = 2.638 m at that one.
constexpr double kArrival = 0.358, kSecondWave = 3.84;

constexpr double kTankLength = 3.22, kBoxFront = 0.8245;

// The pressure in a state, by what the next millisecond does to its velocity.
double pressureAt(const sim::State& state, const sim::SolidField& solid, const sim::Options& options,
                  const Vec3d& place) {
  constexpr double kDt = 1e-3;
  const double h = solid.voxelSize;
  sim::Velocity before = state.velocity, after = sim::copyOf(state.velocity);
  sim::advectVelocity(before, before, after, *state.phi, *solid.phi, kDt, solid.visibility.get());
  for (int a = 0; a < 3; ++a) {
    const float change = static_cast<float>(options.gravity[a] * kDt);
    if (change == 0.0f) continue;
    for (auto it = after.component[a]->beginValueOn(); it; ++it) it.setValue(*it + change);
  }
  sim::PressureOptions settings;
  settings.keepPressure = true;
  settings.suction = 0.1 * options.density * options.gravity.length() * h;
  const sim::Projection projection = sim::project(after, *state.phi, solid, kDt, options.density, settings);
  if (!projection.report.converged) return 0.0;
  return projection.pressure->tree().getValue(Coord::floor(place / h));
}

// `resolution`: cells along the tank.
Result marin(int resolution, const Progress& progress) {
  constexpr int kRate = 100;
  constexpr double kTime = 5.0;
  sim::Options options;
  options.size = Vec3d(kTankLength, 1.0, 1.0);
  options.resolution = resolution;
  options.viscosity = 0.0;
  options.frameRate = kRate;
  options.liquid = {{{sim::Box{Vec3d(1.992, -1.0, -1.0), Vec3d(4.0, 2.0, 0.55)}}}};
  options.solids.resize(1);
  options.solids[0].shape.kind = sim::Box{Vec3d(0.6635, 0.2955, -1.0), Vec3d(kBoxFront, 0.6985, 0.161)};
  const double h = options.voxelSize();
  const auto solid = sim::Solids(options).at(0.0);
  sim::Solver solver(options);
  const double first = solver.next().stats.volume;
  const int cells = static_cast<int>(1.0 / h), row = static_cast<int>(0.5 / h);
  const auto heightAt = [&](double x) {
    return columnDepth(solver.state(), static_cast<int>(x / h), row, cells);
  };
  const std::string label = fmt::format("{} cells", resolution);
  Curve near{label + ", x = 0.992 m", {}, Curve::Style::line},
      far{label + ", x = 2.638 m", {}, Curve::Style::line}, push{label, {}, Curve::Style::line};
  double worst = 0.0, arrival = 0.0, peak = 0.0;
  const int frames = static_cast<int>(kTime * kRate);
  for (int n = 0; n <= frames; ++n) {
    const double time = double(n) / kRate;
    if (n > 0) worst = std::max(worst, std::abs(solver.next().stats.volume / first - 1.0));
    near.points.push_back({time, heightAt(0.992)});
    far.points.push_back({time, heightAt(2.638)});
    if (arrival == 0.0 && near.points.back()[1] > 0.01) {
      const double was = near.points[n - 1][1];
      arrival = time - (near.points.back()[1] - 0.01) / (near.points.back()[1] - was) / kRate;
    }
    if (time > 0.35 && time < 0.6) {
      // One cell off the wall, the pressure of the cell that the gauge faces.
      const double pressure =
          pressureAt(solver.state(), *solid, options, Vec3d(kBoxFront + 0.5 * h, 0.471, 0.061));
      push.points.push_back({time, 1e-3 * pressure});
      peak = std::max(peak, pressure);
    }
    if (progress) progress(double(n) / frames);
  }
  const std::string test = "marin";
  double nearOff = 0.0, farOff = 0.0, nearMost = 0.0, farMost = 0.0, measuredPeak = 0.0;
  Curve nearGauge{"measured, x = 0.992 m", {}, Curve::Style::marks},
      farGauge{"measured, x = 2.638 m", {}, Curve::Style::marks},
      pushGauge{"measured", {}, Curve::Style::marks};
  for (const auto& [time, a, b] : kHeights) {
    const auto n = static_cast<std::size_t>(std::lround(time * kRate));
    nearOff += std::abs(near.points[n][1] - a) / std::size(kHeights);
    farOff += std::abs(far.points[n][1] - b) / std::size(kHeights);
    nearMost = std::max(nearMost, a);
    farMost = std::max(farMost, b);
    nearGauge.points.push_back({time, a});
    farGauge.points.push_back({time, b});
  }
  for (const auto& [time, pressure] : kPressure) {
    measuredPeak = std::max(measuredPeak, pressure);
    pushGauge.points.push_back({time, 1e-3 * pressure});
  }
  std::array<double, 2> second{0.0, 0.0};
  for (const auto& point : far.points)
    if (point[0] > 3.0 && point[0] < 4.6 && point[1] > second[1]) second = point;
  const auto figure = [&](const char* measure, double value, double must, std::optional<double> goal,
                          std::vector<Published> published) {
    Row r{test, resolution, measure, value, {}, goal, false, std::move(published), 0.0};
    if (h <= 0.025 && must > 0.0) r.must = must;
    return r;
  };
  Result result;
  result.rows = {
      figure("height at x = 0.992 m, mean error, % of the highest", 100.0 * nearOff / nearMost, 6.0, 3.0,
             {{3.0, "interFoam, 81 cells along the tank, 1.5 s"}}),
      figure("height at x = 2.638 m, mean error, % of the highest", 100.0 * farOff / farMost, 6.0, 2.0,
             {{1.8, "interFoam, 81 cells along the tank, 1.5 s"}}),
      figure("arrival at x = 0.992 m, error, ms", 1e3 * (arrival - kArrival), 20.0, 8.0,
             {{70.0, "REEF3D level set, dx 0.025 m"}}),
      figure("pressure's peak on the box, error, %", 100.0 * (peak / measuredPeak - 1.0), 20.0, 10.0,
             {{-15.5, "interFoam, 81 cells along the tank"}}),
      figure("second wave, time of the highest water, error, s", second[0] - kSecondWave, 0.0, 0.05, {}),
      figure("worst volume change, %", 100.0 * worst, 1.0, 0.1, {{-19.0, "REEF3D level set, dx 0.025 m"}})};
  result.plots = {{fmt::format("{}_{}", test, resolution),
                   "Water against a box: heights",
                   "time (s)",
                   "height (m)",
                   false,
                   false,
                   {std::move(near), std::move(nearGauge), std::move(far), std::move(farGauge)}},
                  {fmt::format("{}_pressure_{}", test, resolution),
                   "Water against a box: pressure on its front",
                   "time (s)",
                   "pressure (kPa)",
                   false,
                   false,
                   {std::move(push), std::move(pushGauge)}}};
  return result;
}

}  // namespace

std::vector<Case> marinCases() {
  return {{"marin", "fluid", "Water runs against a box; cells along the tank", {65, 129}, {}, marin, {}}};
}

}  // namespace fluidtex::validation
