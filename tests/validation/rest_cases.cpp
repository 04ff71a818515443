// Sections C.3 and C.4 of the reference: liquid that should not move, and liquid that only falls.
#include "tests/validation/rest_cases.h"

#include "tests/validation/measure.h"
#include "tests/validation/solver_run.h"

#include <cmath>
#include <numbers>

namespace fluidtex::validation {
namespace {

using sim::Coord;
using sim::Vec3d;

constexpr double kGravity = 9.81;

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
    fastest = std::max(fastest, farthestFrom(solver.state(), [](const Vec3d&) { return Vec3d(0.0); }));
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

Result level(int resolution, const Progress& progress) {
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
  const Vec3d speed = kGravity * (duration + solver.state().ahead) * down;
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
      {"rest_level", "fluid", "A level pool at rest", {32, 64}, {32}, level, {}},
      {"rest_tilted", "fluid", "A pool at rest under gravity tilted by 30 degrees", {32, 64}, {}, tilted, {}},
      {"rest_bowl", "fluid", "A pool at rest in a round bowl", {32, 64}, {}, bowl, {}},
      {"rest_ball", "fluid", "A pool at rest around a solid ball", {32, 64}, {}, aroundBall, {}},
      {"free_fall", "fluid", "A ball of liquid falls 0.4 m", {64}, {64}, fallStraight, {}},
      {"free_fall_45", "fluid", "The same along a diagonal", {64}, {}, fallAslant, {}}};
}

}  // namespace fluidtex::validation
