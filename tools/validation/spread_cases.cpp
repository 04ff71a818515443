// Huppert, "The propagation of two-dimensional and axisymmetric viscous gravity currents over a rigid
// horizontal surface", 1982.
#include "tools/validation/spread_cases.h"

#include "sim/step/solver.h"
#include "tools/validation/solver_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fluidtex::validation {
namespace {

using sim::Coord;
using sim::Vec3d;
using std::numbers::pi;

// Farthest crossing of the surface along x, in the row of cells j, metres.
double reachAlongX(const sim::State& state, int j, const Coord& cells) {
  const auto phi = state.phi->getConstUnsafeAccessor();
  double reach = 0.0;
  for (int k = 0; k < cells[2]; ++k) {
    for (int i = cells[0] - 1; i >= 0; --i) {
      const double here = phi.getValue(Coord(i, j, k)), next = phi.getValue(Coord(i + 1, j, k));
      if (here >= 0.0 || next < 0.0) continue;
      reach = std::max(reach, i + 0.5 + here / (here - next));
      break;
    }
  }
  return reach * state.phi->voxelSize()[0];
}

struct Spread {
  std::string test;
  bool round;         // a quarter of a round block instead of one half of a long one
  double power;       // of time
  double law;         // front of the law at unit time
  double from;        // the fit starts when the front is there, m
  double end;         // s g / (3 nu)
  double must, goal;  // of the power
};

// A block 1 m high and wide; lengths in m, times in those in which g / (3 nu) is 1.
Result spread(const Spread& flow, int resolution, const Progress& progress) {
  // sqrt(g) / nu. When the fit begins, inertia is a ten-thousandth of the weight.
  constexpr double kReynolds = 5.0;
  constexpr int kFrames = 200;
  const double gravity = 1.0, viscosity = std::sqrt(gravity) / kReynolds, unit = 3.0 * viscosity / gravity;
  const double h = 1.0 / resolution, room = 1.15 * flow.law * std::pow(flow.end, flow.power) + 8.0 * h;
  sim::Options options;
  options.size = Vec3d(room, flow.round ? room : 8.0 * h, 1.25);
  options.resolution = static_cast<int>(std::ceil(room * resolution));
  options.size *= options.resolution * h / room;
  if (!flow.round) options.size[1] = 8.0 * h;
  options.size[2] = 1.25;
  options.gravity = Vec3d(0.0, 0.0, -gravity);
  options.viscosity = viscosity * options.density;
  options.cfl = 4.0;
  options.frameRate = kFrames / (flow.end * unit);
  options.walls = {{sim::DomainFace::zLow, {.kind = sim::WallKind::noSlip}}};
  if (flow.round) {
    options.liquid = {{{sim::Cylinder{Vec3d(0.0, 0.0, -1.0), Vec3d(0.0, 0.0, 1.0), 1.0}}}};
  } else {
    options.liquid = {{{sim::Box{Vec3d(-1.0), Vec3d(1.0)}}}};
    options.liquid[0].shape.kind = sim::Box{Vec3d(-1.0, -1.0, -1.0), Vec3d(1.0, 100.0, 1.0)};
  }
  sim::Solver solver(options);
  const Coord cells = sim::cellCount(options.size, options.voxelSize());
  const double before = solver.next().stats.volume;
  Curve front{fmt::format("{} cells to the block's height", resolution), {}, Curve::Style::line},
      law{"law", {}, Curve::Style::line};
  double volume = before;
  for (int n = 1; n <= kFrames; ++n) {
    volume = solver.next().stats.volume;
    const double time = flow.end * n / kFrames;
    front.points.push_back({time, reachAlongX(solver.state(), flow.round ? 0 : 4, cells)});
    law.points.push_back({time, flow.law * std::pow(time, flow.power)});
    if (progress) progress(double(n) / kFrames);
  }
  // Slope of log x over log t, weighted so that each part of log t counts alike.
  double w = 0.0, sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (const auto& [t, x] : front.points) {
    if (x < flow.from) continue;
    const double weight = 1.0 / t, a = std::log(t), b = std::log(x);
    w += weight, sx += weight * a, sy += weight * b, sxx += weight * a * a, sxy += weight * a * b;
  }
  const double power = (w * sxy - sx * sy) / (w * sxx - sx * sx);
  const double last = front.points.back()[1], exact = law.points.back()[1];
  const double thickness = surfaceHeight(solver.state(), 0, flow.round ? 0 : 4, cells[2]) / h;
  const auto row = [&](const char* measure, double value, std::optional<double> must,
                       std::optional<double> goal) {
    return Row{flow.test, resolution, measure, value, must, goal, false, {}, 0.0};
  };
  Result result;
  result.rows = {row("power of time less the law's", power - flow.power, flow.must, flow.goal),
                 row("front at the end, error, %", 100.0 * (last / exact - 1.0), 3.0, 1.0),
                 row("thickness at the end, cells", thickness, {}, {}),
                 row("volume change, %", 100.0 * (volume / before - 1.0), {}, {})};
  result.plots = {{fmt::format("{}_{}", flow.test, resolution),
                   "Front of a spreading viscous block",
                   "t g / (3 nu)",
                   "front (m)",
                   true,
                   false,
                   {std::move(front), std::move(law)}}};
  return result;
}

// Volume of one side 1 m2 a metre of width.
Result plane(int resolution, const Progress& progress) {
  return spread({"spread", false, 0.2, 1.4112, 4.0, 1000.0, 0.01, 0.003}, resolution, progress);
}

// Volume of all four quarters pi m3.
Result axial(int resolution, const Progress& progress) {
  return spread({"spread_round", true, 0.125, 0.8939 * std::pow(pi, 0.375), 2.6, 1000.0, 0.01, 0.003},
                resolution, progress);
}

}  // namespace

std::vector<Case> spreadCases() {
  return {{"spread", "viscous", "A long viscous block spreads; cells to its height", {20, 40}, {}, plane, {}},
          {"spread_round",
           "viscous",
           "A round viscous block spreads; cells to its height",
           {20, 40},
           {},
           axial,
           {}}};
}

}  // namespace fluidtex::validation
