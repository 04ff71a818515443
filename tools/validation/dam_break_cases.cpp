// Collapsing columns: what of the liquid is left, and how fast the front runs.
#include "tools/validation/dam_break_cases.h"

#include "sim/step/solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace fluidtex::validation {
namespace {

// The column of liquid in a closed box of 1 m that peers were measured on.
sim::Options closedBox(int resolution) {
  sim::Options options;
  options.resolution = resolution;
  options.viscosity = 0.0;
  options.liquid = {{{sim::Box{sim::Vec3d(0.0), sim::Vec3d(0.4, 1.0, 0.5)}}}};
  return options;
}

Result volumeOfDamBreak(int resolution, const Progress& progress) {
  constexpr int kFrames = 240;
  sim::Solver solver(closedBox(resolution));
  Curve kept{fmt::format("{} cells", resolution), {}, Curve::Style::line};
  double first = 0.0, worst = 0.0;
  std::vector<double> share;
  for (int frame = 1; frame <= kFrames; ++frame) {
    const double volume = solver.next().stats.volume;
    if (frame == 1) first = volume;
    share.push_back(volume / first);
    worst = std::max(worst, std::abs(volume / first - 1.0));
    kept.points.push_back({double(frame), 100.0 * volume / first});
    if (progress) progress(double(frame) / kFrames);
  }
  const std::string test = "dam_break";
  const auto change = [&](int frame) { return 100.0 * (share[frame - 1] - 1.0); };
  const auto row = [&](const std::string& measure, double value, std::vector<Published> published) {
    return Row{test, resolution, measure, value, {}, {}, false, std::move(published), 0.0};
  };
  Result result;
  const bool coarse = resolution == 64;
  const auto peers = [&](double mantaflow, double jet, double flip) {
    if (!coarse) return std::vector<Published>{};
    return std::vector<Published>{
        {mantaflow, "Blender 3.4 mantaflow FLIP"}, {jet, "jet level set"}, {flip, "jet FLIP"}};
  };
  result.rows = {row("volume change, frame 12, %", change(12), peers(4, -3, -7)),
                 row("volume change, frame 24, %", change(24), peers(28, -15, -28)),
                 row("volume change, frame 48, %", change(48), peers(54, -39, -45)),
                 row("volume change, frame 240, %", change(240), {}),
                 row("worst volume change, %", 100.0 * worst, {})};
  result.rows.back().must = 2.0;
  result.rows.back().goal = 0.5;
  result.plots = {{fmt::format("{}_{}", test, resolution),
                   "Closed dam break: liquid kept",
                   "frame",
                   "volume (%)",
                   false,
                   false,
                   {std::move(kept)}}};
  return result;
}

// Front of a column of base a and height 2 a after T = t sqrt(2 g / a), in units of a: Martin and Moyce 1952.
constexpr double kFront[][2] = {{.41, 1.11},  {.84, 1.22},  {1.19, 1.44}, {1.43, 1.67}, {1.63, 1.89},
                                {1.83, 2.11}, {1.98, 2.33}, {2.20, 2.56}, {2.32, 2.78}, {2.51, 3.00},
                                {2.65, 3.22}, {2.83, 3.44}, {2.98, 3.67}, {3.11, 3.89}, {3.33, 4.11}};

// Linear between the points of a curve that rises in its first value.
double valueAt(const std::vector<std::array<double, 2>>& curve, double x) {
  const auto after =
      std::lower_bound(curve.begin(), curve.end(), x, [](const auto& p, double at) { return p[0] < at; });
  if (after == curve.begin()) return curve.front()[1];
  if (after == curve.end()) return curve.back()[1];
  const auto before = std::prev(after);
  return (*before)[1] + (x - (*before)[0]) / ((*after)[0] - (*before)[0]) * ((*after)[1] - (*before)[1]);
}

// `resolution`: cells to the column's base.
Result martinMoyce(int resolution, const Progress& progress) {
  constexpr double kBase = 0.146, kLongest = 3.6, kLength = 6.0;
  constexpr int kFrames = 72;
  const double h = kBase / resolution, unit = std::sqrt(kBase / (2.0 * kGravity));
  sim::Options options;
  options.size = sim::Vec3d(kLength * kBase, 8.0 * h, 2.5 * kBase);
  options.resolution = static_cast<int>(std::lround(kLength * resolution));
  options.viscosity = 0.0;
  options.frameRate = kFrames / (kLongest * unit);
  options.liquid = {{{sim::Box{sim::Vec3d(0.0), sim::Vec3d(kBase, 1.0, 2.0 * kBase)}}}};
  sim::Solver solver(options);
  std::vector<std::array<double, 2>> front;
  double first = 0.0, worst = 0.0;
  for (int frame = 0; frame <= kFrames; ++frame) {
    const double volume = solver.next().stats.volume;
    if (frame == 0) first = volume;
    worst = std::max(worst, std::abs(volume / first - 1.0));
    // The farthest liquid on the floor.
    const auto phi = solver.state().phi->getConstUnsafeAccessor();
    double reach = 0.0;
    for (int i = 0; i < options.resolution; ++i) {
      const double here = phi.getValue(openvdb::Coord(i, 4, 0)),
                   next = phi.getValue(openvdb::Coord(i + 1, 4, 0));
      if (here < 0.0 && next >= 0.0) reach = (i + 0.5 + here / (here - next)) * h;
    }
    front.push_back({frame * kLongest / kFrames, reach / kBase});
    if (progress) progress(double(frame) / kFrames);
  }
  // The experiment's gate took time to open: one shift of at most 0.2 in T.
  double bestShift = 0.0, bestMean = 1e9, bestMost = 0.0, rawMean = 0.0;
  for (int n = -200; n <= 200; ++n) {
    const double shift = 0.001 * n;
    double mean = 0.0, most = 0.0;
    for (const auto& [t, z] : kFront) {
      const double error = std::abs(valueAt(front, t - shift) / z - 1.0);
      mean += error / std::size(kFront);
      most = std::max(most, error);
    }
    if (n == 0) rawMean = mean;
    if (mean < bestMean) bestMean = mean, bestMost = most, bestShift = shift;
  }
  const std::string test = "martin_moyce";
  const auto row = [&](const std::string& measure, double value, std::optional<double> must,
                       std::optional<double> goal) {
    return Row{test, resolution, measure, value, must, goal, false, {}, 0.0};
  };
  Result result;
  result.rows = {row("front, mean error, %", 100.0 * bestMean, 4.0, 2.0),
                 row("front, max error, %", 100.0 * bestMost, 8.0, 4.0),
                 row("fitted shift of T", bestShift, 0.2, {}),
                 row("front, mean error unshifted, %", 100.0 * rawMean, {}, {}),
                 row("worst volume change, %", 100.0 * worst, 0.5, 0.05)};
  result.rows[0].published = {{7.5, "REEF3D level set, a/20 to a/40"}};
  result.rows[1].published = {{19.0, "REEF3D level set, a/20 to a/40"}};
  Curve measured{"Martin and Moyce 1952", {}, Curve::Style::marks},
      shifted{fmt::format("{} cells, shifted", resolution), {}, Curve::Style::line};
  for (const auto& [t, z] : kFront) measured.points.push_back({t, z});
  for (const auto& [t, z] : front) shifted.points.push_back({t + bestShift, z});
  result.plots = {{fmt::format("{}_{}", test, resolution),
                   "Front of a collapsing column",
                   "t sqrt(2 g / a)",
                   "x / a",
                   false,
                   false,
                   {std::move(measured), std::move(shifted)}}};
  return result;
}

}  // namespace

std::vector<Case> damBreakCases() {
  return {{"martin_moyce",
           "fluid",
           "Front of a collapsing column, cells to its base",
           {20, 40},
           {},
           martinMoyce,
           {}},
          {"dam_break",
           "fluid",
           "Volume of a closed dam break over 240 frames",
           {64, 128},
           {},
           volumeOfDamBreak,
           {}}};
}

}  // namespace fluidtex::validation
