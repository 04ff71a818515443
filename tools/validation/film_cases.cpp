#include "tools/validation/film_cases.h"

#include "sim/solids/solids.h"
#include "tools/validation/solver_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fluidtex::validation {
namespace {

using sim::Coord;
using sim::Vec3d;

// A film 1 m deep on a slope of 30 degrees, with the Reynolds number flux / viscosity = 1; z is the distance
// from the ground. It starts as it should stay; each layer of cells comes in with its own mean speed.
// `resolution`: cells to the depth.
Result film(int resolution, const Progress& progress) {
  constexpr double kLength = 16.0, kSource = 0.5, kTime = 12.0;
  const double h = 1.0 / resolution, angle = std::numbers::pi / 6.0, along = kGravity * std::sin(angle);
  const double viscosity = std::sqrt(along / 3.0), flux = along / (3.0 * viscosity);
  const auto speed = [=](double z) { return along / (2.0 * viscosity) * (2.0 * z - z * z); };
  // Speed integrated from the ground up.
  const auto passed = [=](double z) { return along / (2.0 * viscosity) * (z * z - z * z * z / 3.0); };
  sim::Options options;
  options.size = Vec3d(kLength, 8.0 * h, 1.5);
  options.resolution = static_cast<int>(kLength) * resolution;
  options.gravity = Vec3d(along, 0.0, -kGravity * std::cos(angle));
  options.viscosity = viscosity * options.density;
  options.cfl = 1.0;
  options.frameRate = 2.0;
  options.walls = {{sim::DomainFace::zLow, {.kind = sim::WallKind::noSlip}}};
  options.sides[1] = sim::Side::open;
  options.sides[2] = options.sides[3] = sim::Side::symmetry;
  options.liquid = {{{sim::HalfSpace{Vec3d(0.0, 0.0, 1.0), Vec3d(0.0, 0.0, 1.0)}}}};
  for (int k = 0; k < resolution; ++k) {
    sim::Source layer;
    layer.shape = {sim::Box{Vec3d(-1.0, -1.0, k == 0 ? -1.0 : k * h), Vec3d(kSource, 100.0, (k + 1) * h)}};
    layer.velocity = Vec3d((passed((k + 1) * h) - passed(k * h)) / h, 0.0, 0.0);
    options.sources.push_back(layer);
  }
  sim::Solver solver = startedWith(
      options, [&](const Vec3d& x) { return Vec3d(speed(std::clamp(x[2], 0.0, 1.0)), 0.0, 0.0); });
  const int frames = static_cast<int>(kTime * options.frameRate), cells = static_cast<int>(1.5 * resolution);
  double before = 0.0, volume = 0.0;
  for (int n = 1; n <= frames; ++n) {
    before = volume;
    volume = solver.next().stats.volume;
    if (progress) progress(double(n) / frames);
  }
  // Away from both ends: what they do to the depth fades by e within about a depth.
  const sim::State& state = solver.state();
  double depth = 0.0, profile = 0.0, here = 0.0;
  Curve level{fmt::format("{} cells", resolution), {}, Curve::Style::line};
  for (int i = 0; i < options.resolution; ++i) {
    const double z = surfaceHeight(state, i, 4, cells), x = (i + 0.5) * h;
    level.points.push_back({x, z});
    if (x > 0.25 * kLength && x < 0.75 * kLength) depth = std::max(depth, std::abs(z - 1.0));
  }
  const auto u = state.velocity.component[0]->getConstUnsafeAccessor();
  const int middle = options.resolution / 2;
  Curve found{fmt::format("{} cells", resolution), {}, Curve::Style::marks},
      exact{"exact", {}, Curve::Style::line};
  for (int k = 0; k < resolution; ++k) {
    const double z = (k + 0.5) * h, value = u.getValue(Coord(middle, 4, k));
    profile = std::max(profile, std::abs(value - speed(z)));
    here += value * h;
    found.points.push_back({value, z});
    exact.points.push_back({speed(z), z});
  }
  const std::string test = "film";
  const auto row = [&](const char* measure, double value, std::optional<double> must,
                       std::optional<double> goal) {
    return Row{test, resolution, measure, value, must, goal, false, {}, 0.0};
  };
  Row off = row("depth off, worst in the middle half, %", 100.0 * depth, {}, 0.1);
  if (resolution >= 16) off.must = 1.0;
  return {{off, row("speed's error, max, % of the surface's", 100.0 * profile / speed(1.0), {}, 1e-6),
           row("flux in the middle, error, %", 100.0 * (here / flux - 1.0), {}, {}),
           row("volume change in the last half second, share of what came in",
               (volume - before) * options.frameRate / (flux * options.size[1]), {}, 1e-8)},
          {{fmt::format("{}_{}", test, resolution),
            "A film on a slope: speed over the distance from the ground",
            "speed (m/s)",
            "distance (m)",
            false,
            false,
            {std::move(found), std::move(exact)}},
           {fmt::format("{}_level_{}", test, resolution),
            "A film on a slope: depth",
            "x (m)",
            "depth (m)",
            false,
            false,
            {std::move(level)}}}};
}

}  // namespace

std::vector<Case> filmCases() {
  return {{"film", "viscous", "A viscous film down a slope; cells to its depth", {8, 16}, {}, film, {}}};
}

}  // namespace fluidtex::validation
