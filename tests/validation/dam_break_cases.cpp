// Collapsing columns: what of the liquid is left, and how fast the front runs.
#include "tests/validation/dam_break_cases.h"

#include "sim/solver.h"

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

}  // namespace

std::vector<Case> damBreakCases() {
  return {{"dam_break",
           "fluid",
           "Volume of a closed dam break over 240 frames",
           {64, 128},
           {},
           volumeOfDamBreak,
           {}}};
}

}  // namespace fluidtex::validation
