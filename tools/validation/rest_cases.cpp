// Sections C.3 and C.4 of the reference: liquid that should not move, and liquid that only falls.
#include "tools/validation/rest_cases.h"

#include "tools/validation/face_velocities.h"
#include "tools/validation/measure.h"
#include "tools/validation/solver_run.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

namespace fluidtex::validation {
namespace {

using sim::Coord;
using sim::Vec3d;

// A pool at rest in a box of 1 m below a plane square to gravity, for 10 sqrt(L / g); with solids in it the
// surface is no longer compared with the plane.
Result pool(const std::string& test, const Vec3d& up, const Vec3d& point,
            const std::vector<sim::Solid>& solids, int resolution, const Progress& progress) {
  const Distance plane = [=](const Vec3d& x) { return (x - point).dot(up); };
  sim::Options options;
  options.resolution = resolution;
  options.gravity = -kGravity * up;
  options.viscosity = 0.0;
  options.liquid = {{{sim::HalfSpace{point, up}}}};
  options.solids = solids;
  const double duration = 10.0 / std::sqrt(kGravity);
  const int frames = static_cast<int>(std::ceil(duration * options.frameRate));
  sim::Solver solver(options);
  const Coord cells(resolution), samples(2);
  const double first = solver.next().stats.volume;
  double fastest = 0.0, last = first;
  for (int n = 0; n < frames; ++n) {
    last = solver.next().stats.volume;
    fastest = std::max(fastest, fastestOf(solver.state()));
    if (progress) progress((n + 1.0) / frames);
  }
  const double drift = compare(*solver.state().phi, plane, cells, samples).farthest * resolution;
  Result result;
  if (!solids.empty()) {
    result.rows = {
        {test, resolution, "max |u| / sqrt(g L)", fastest / std::sqrt(kGravity), 1e-5, 1e-6, false, {}, 0.0},
        {test, resolution, "volume change", last / first - 1.0, 1e-6, {}, false, {}, 0.0}};
    return result;
  }
  result.rows = {
      {test, resolution, "max |u| / sqrt(g L)", fastest / std::sqrt(kGravity), 1e-5, 1e-9, false, {}, 0.0},
      {test, resolution, "surface off its place, h", drift, 0.01, {}, false, {}, 0.0},
      {test, resolution, "volume change", last / first - 1.0, 1e-6, {}, false, {}, 0.0}};
  return result;
}

Result levelPool(int resolution, const Progress& progress) {
  return pool("rest_level", Vec3d(0.0, 0.0, 1.0), Vec3d(0.5, 0.5, 0.437), {}, resolution, progress);
}

Result tilted(int resolution, const Progress& progress) {
  const double angle = std::numbers::pi / 6.0;
  return pool("rest_tilted", Vec3d(std::sin(angle), 0.0, std::cos(angle)), Vec3d(0.5, 0.5, 0.45), {},
              resolution, progress);
}

// A round bowl cut out of a block.
Result bowl(int resolution, const Progress& progress) {
  sim::Solid solid;
  solid.shape = {
      sim::Difference{{{sim::Box{Vec3d(-1.0), Vec3d(2.0)}}, {sim::Sphere{Vec3d(0.5, 0.5, 0.55), 0.43}}}}};
  return pool("rest_bowl", Vec3d(0.0, 0.0, 1.0), Vec3d(0.5, 0.5, 0.437), {solid}, resolution, progress);
}

Result aroundBall(int resolution, const Progress& progress) {
  sim::Solid solid;
  solid.shape = {sim::Sphere{Vec3d(0.48, 0.52, 0.2), 0.17}};
  return pool("rest_ball", Vec3d(0.0, 0.0, 1.0), Vec3d(0.5, 0.5, 0.437), {solid}, resolution, progress);
}

// A pool that fills the lower part of a box whose sides are no whole number of cells, for 60 frames, with
// every pair of a viscosity and a kind of wall, with and without heat. The worst of each figure.
Result viscousPool(int resolution, const Progress& progress) {
  constexpr double kViscosities[] = {1e-3, 1.0, 1e2, 1e4, 1e6};
  constexpr sim::WallKind kWalls[] = {sim::WallKind::slip, sim::WallKind::friction, sim::WallKind::noSlip};
  constexpr int kFrames = 60, kRuns = 2 * int(std::size(kViscosities) * std::size(kWalls));
  constexpr double kLevel = 0.31;
  const std::string test = "rest_viscous";
  double fastest = 0.0, drift = 0.0, volume = 0.0;
  int run = 0;
  for (const double viscosity : kViscosities) {
    for (const sim::WallKind wall : kWalls) {
      for (const bool heat : {false, true}) {
        sim::Options options;
        options.size = Vec3d(1.0, 0.53, 0.77);
        options.resolution = resolution;
        options.viscosity = viscosity;
        options.walls = {{sim::DomainFace::all, {.kind = wall}}};
        options.heat.simulated = heat;
        options.liquid = {{{sim::Box{Vec3d(0.0), Vec3d(1.0, 0.53, kLevel)}}}};
        sim::Solver solver(options);
        const double first = solver.next().stats.volume;
        for (int n = 0; n < kFrames; ++n) {
          const double last = solver.next().stats.volume;
          volume = std::max(volume, std::abs(last / first - 1.0));
          fastest = std::max(fastest, fastestOf(solver.state()));
          if (progress) progress((run + (n + 1.0) / kFrames) / kRuns);
        }
        for (int i = 1; i < resolution; i += 3)
          drift = std::max(drift, std::abs(surfaceHeight(solver.state(), i, 2, resolution) - kLevel));
        ++run;
      }
    }
  }
  Result result;
  result.rows = {
      {test, resolution, "max |u| / sqrt(g L)", fastest / std::sqrt(kGravity), 1e-5, 1e-6, false, {}, 0.0},
      {test, resolution, "surface off its place, h", drift * resolution, 0.5, 0.05, false, {}, 0.0},
      {test, resolution, "volume change", volume, 1e-4, 1e-6, false, {}, 0.0}};
  return result;
}

// A ball of liquid falls 0.4 m.
Result fall(const std::string& test, const Vec3d& down, const Vec3d& start, int resolution,
            const Progress& progress) {
  constexpr double kRadius = 0.15, kWay = 0.4;
  const double duration = std::sqrt(2.0 * kWay / kGravity);
  constexpr int kFrames = 8;
  sim::Options options;
  options.resolution = resolution;
  options.gravity = kGravity * down;
  options.viscosity = 0.0;
  options.frameRate = kFrames / duration;
  options.liquid = {{{sim::Sphere{start, kRadius}}}};
  sim::Solver solver(options);
  const Coord cells(resolution), samples(4);
  solver.next();
  const double before = compare(*solver.state().phi, sphere(start, kRadius), cells, samples).volume;
  for (int n = 0; n < kFrames; ++n) {
    solver.next();
    if (progress) progress((n + 1.0) / kFrames);
  }
  // The velocity is that of the middle of the next substep.
  const Vec3d speed = kGravity * (duration + solver.state().leapfrogOffset) * down;
  const double error = farthestFrom(solver.state(), [&](const Vec3d&) { return speed; });
  const ShapeError shape = compare(*solver.state().phi, sphere(start + kWay * down, kRadius), cells, samples);
  Result result;
  result.rows = {
      {test, resolution, "velocity error, relative", error / speed.length(), 1e-6, 1e-10, false, {}, 0.0},
      {test, resolution, "E_V, %", 100.0 * (shape.volume / before - 1.0), 0.1, 1e-4, false, {}, 0.0},
      {test, resolution, "E_inf, h", shape.farthest * resolution, 0.2, 0.02, false, {}, 0.0}};
  return result;
}

Result fallStraight(int resolution, const Progress& progress) {
  return fall("free_fall", Vec3d(0.0, 0.0, -1.0), Vec3d(0.5, 0.5, 0.75), resolution, progress);
}

Result fallAslant(int resolution, const Progress& progress) {
  const double a = std::sqrt(0.5);
  return fall("free_fall_45", Vec3d(a, 0.0, -a), Vec3d(0.3, 0.5, 0.7), resolution, progress);
}

}  // namespace

std::vector<Case> restCases() {
  return {
      {"rest_level", "fluid", "A level pool at rest", {32, 64}, {32}, levelPool, {}},
      {"rest_tilted", "fluid", "A pool at rest under gravity tilted by 30 degrees", {32, 64}, {}, tilted, {}},
      {"rest_bowl", "fluid", "A pool at rest in a round bowl", {32, 64}, {}, bowl, {}},
      {"rest_ball", "fluid", "A pool at rest around a solid ball", {32, 64}, {}, aroundBall, {}},
      {"rest_viscous",
       "fluid",
       "A pool at rest, of any viscosity and with any wall, in a box of no whole number of cells",
       {16, 32, 48},
       {},
       viscousPool,
       {}},
      {"free_fall", "fluid", "A ball of liquid falls 0.4 m", {64}, {64}, fallStraight, {}},
      {"free_fall_45", "fluid", "The same along a diagonal", {64}, {}, fallAslant, {}}};
}

}  // namespace fluidtex::validation
