// Ritter, "Die Fortpflanzung der Wasserwellen", 1892 (dam on a dry bed); Belanger 1828 (hydraulic jump). Both
// on channels one leaf wide with lengths in depths; times in those in which a long wave runs one depth.
#include "tools/validation/shallow_cases.h"

#include "sim/step/solver.h"
#include "tools/validation/solver_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace fluidtex::validation {
namespace {

using sim::Vec3d;

const double kWave = std::sqrt(kGravity);  // m/s, of long waves on water 1 m deep

sim::Options slabChannel(double length, double height, int resolution) {
  sim::Options options;
  options.size = Vec3d(length, 8.0 / resolution, height);
  options.resolution = static_cast<int>(std::lround(length * resolution));
  options.sides[2] = options.sides[3] = sim::Side::symmetry;
  options.viscosity = 0.0;
  return options;
}

// A reservoir 1 m deep is let go at once; `resolution`: cells to its depth.
Result ritter(int resolution, const Progress& progress) {
  constexpr double kDam = 9.0, kLength = 26.0, kFrom = 4.0, kTo = 8.0;
  constexpr int kPerUnit = 5;
  sim::Options options = slabChannel(kLength, 1.25, resolution);
  options.frameRate = kPerUnit * kWave;
  options.liquid = {{{sim::Box{Vec3d(-1.0), Vec3d(kDam, 100.0, 1.0)}}}};
  sim::Solver solver(options);
  const double before = solver.next().stats.volume;
  const int cells = static_cast<int>(1.25 * resolution), dam = static_cast<int>(kDam * resolution);
  double atDam = 0.0, difference = 0.0, volume = before;
  Curve exactCurve{"Ritter", {}, Curve::Style::line},
      found{fmt::format("{} cells", resolution), {}, Curve::Style::line};
  const int frames = static_cast<int>(kTo * kPerUnit);
  for (int n = 1; n <= frames; ++n) {
    volume = solver.next().stats.volume;
    if (progress) progress(double(n) / frames);
    const double t = double(n) / kPerUnit;
    if (t < kFrom) continue;
    const auto depth = [&](int i) { return columnDepth(solver.state(), i, 4, cells); };
    atDam = std::max(atDam, std::abs(0.5 * (depth(dam - 1) + depth(dam)) / (4.0 / 9.0) - 1.0));
    double sum = 0.0;
    int count = 0;
    for (int i = 0; i < options.resolution; ++i) {
      const double x = (i + 0.5) / resolution - kDam;
      if (x < -t || x > t) continue;
      const double exact = std::pow(2.0 - x / t, 2) / 9.0;
      sum += std::abs(depth(i) - exact);
      ++count;
      if (n < frames) continue;
      exactCurve.points.push_back({x, exact});
      found.points.push_back({x, depth(i)});
    }
    difference = std::max(difference, sum / count);
  }
  const std::string test = "ritter";
  return {
      {row(test, resolution, "depth at the dam, worst error, %", 100.0 * atDam, 4.0, 1.5),
       row(test, resolution, "depth, worst mean error, % of the reservoir's", 100.0 * difference, 3.0, 1.5),
       row(test, resolution, "volume change, %", 100.0 * (volume / before - 1.0), {}, {})},
      {{fmt::format("{}_{}", test, resolution),
        "A dam on dry ground, eight times later",
        "x / depth",
        "depth",
        false,
        false,
        {std::move(exactCurve), std::move(found)}}}};
}

// A stream 1 m deep runs against a wall: a jump of Froude number 3 goes back up the stream. `resolution`:
// cells to the stream's depth. The liquid comes to rest behind a roller some six times as long as it is deep
// there. What stills it is the small eddies' friction, a few hundredths of speed times depth, which has to be
// given: a slab has no small eddies, and its whirls would go on for ever. All walls slip, so that friction
// takes no momentum from the liquid.
Result jump(int resolution, const Progress& progress) {
  constexpr double kFroude = 3.0, kLength = 80.0, kHeight = 6.0, kReach = 50.0;
  constexpr double kRoller = 22.0, kEddies = 0.03;
  const double ratio = 0.5 * (std::sqrt(1.0 + 8.0 * kFroude * kFroude) - 1.0);
  // In the frame of the jump the stream has the Froude number; liquid behind it is at rest.
  const double speed = kFroude * kWave * (1.0 - 1.0 / ratio), back = speed / (ratio - 1.0);
  constexpr int kFrames = 240;
  sim::Options options = slabChannel(kLength, kHeight, resolution);
  options.viscosity = kEddies * speed * options.density;
  options.frameRate = kFrames / (kReach / back);
  options.liquid = {{{sim::Box{Vec3d(-1.0), Vec3d(100.0, 100.0, 1.0)}}, Vec3d(speed, 0.0, 0.0)}};
  sim::Source source;
  source.shape = {sim::Box{Vec3d(-1.0), Vec3d(1.0, 100.0, 1.0)}};
  source.velocity = Vec3d(speed, 0.0, 0.0);
  options.sources = {source};
  sim::Solver solver(options);
  const double before = solver.next().stats.volume;
  const int cells = static_cast<int>(kHeight * resolution);
  double volume = before, behind = 0.0;
  int averaged = 0;
  std::vector<std::array<double, 2>> place;  // of the jump, over time
  Curve surface{fmt::format("{} cells", resolution), {}, Curve::Style::line};
  for (int n = 1; n <= kFrames; ++n) {
    volume = solver.next().stats.volume;
    if (progress) progress(double(n) / kFrames);
    if (n < kFrames / 2) continue;
    // Where the depth, averaged over a metre, passes the middle between both depths.
    std::vector<double> depth(options.resolution);
    for (int i = 0; i < options.resolution; ++i) depth[i] = columnDepth(solver.state(), i, 4, cells);
    int front = 0;
    double sum = 0.0;
    for (int i = 0; i < options.resolution; ++i) {
      sum += depth[i] - (i >= resolution ? depth[i - resolution] : 0.0);
      if (i >= resolution && sum / resolution > 0.5 * (1.0 + ratio)) {
        front = i - resolution / 2;
        break;
      }
    }
    place.push_back({n / options.frameRate, double(front) / resolution});
    // The still part: clear of the roller.
    double still = 0.0;
    const int from = front + static_cast<int>(kRoller) * resolution;
    for (int i = from; i < options.resolution; ++i) still += depth[i] / (options.resolution - from);
    if (from < options.resolution - resolution) {
      behind += still;
      ++averaged;
    }
    if (n < kFrames) continue;
    for (int i = 0; i < options.resolution; ++i) surface.points.push_back({(i + 0.5) / resolution, depth[i]});
  }
  double t = 0.0, x = 0.0, tt = 0.0, tx = 0.0;
  for (const auto& [a, b] : place) t += a, x += b, tt += a * a, tx += a * b;
  const double count = static_cast<double>(place.size());
  const double measured = -(count * tx - t * x) / (count * tt - t * t);
  behind /= std::max(averaged, 1);
  // What came in, from the end of the source's cells.
  const double width = options.size[1], inflow = speed * width * kReach / back;
  const std::string test = "hydraulic_jump";
  Curve law{"law",
            {{0.0, 1.0}, {kLength - kReach, 1.0}, {kLength - kReach, ratio}, {kLength, ratio}},
            Curve::Style::line};
  return {{row(test, resolution, "depth behind, error, %", 100.0 * (behind / ratio - 1.0), 5.0, 2.0),
           row(test, resolution, "speed of the jump, error, %", 100.0 * (measured / back - 1.0), {}, {}),
           row(test, resolution, "volume against what came in, %",
               100.0 * (volume - before - inflow) / (before + inflow), {}, {})},
          {{fmt::format("{}_{}", test, resolution),
            "A jump of Froude number 3 that runs upstream",
            "x (m)",
            "depth (m)",
            false,
            false,
            {std::move(surface), std::move(law)}}}};
}

}  // namespace

std::vector<Case> shallowCases() {
  return {{"ritter", "stream", "A dam on a dry bed; cells to the depth", {16, 32}, {}, ritter, {}},
          {"hydraulic_jump", "stream", "A stream against a wall; cells to its depth", {8}, {}, jump, {}}};
}

}  // namespace fluidtex::validation
