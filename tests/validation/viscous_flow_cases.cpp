// Sections C.1, C.2 and C.9 of the reference: the whole solver where friction matters.
#include "tests/validation/viscous_cases.h"

#include "tests/validation/order.h"
#include "tests/validation/solver_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fluidtex::validation {
namespace {

using sim::Coord;
using sim::Vec3d;
using std::numbers::pi;

// A slab one leaf thick, full of liquid, without gravity.
sim::Options fullSlab(int resolution) {
  sim::Options options;
  options.size = Vec3d(1.0, 1.0, 8.0 / resolution);
  options.resolution = resolution;
  options.gravity = Vec3d(0.0);
  options.liquid = {{{sim::Box{Vec3d(-1.0), Vec3d(2.0)}}}};
  return options;
}

Result viscousVortices(int resolution, const Progress& progress) {
  constexpr double kViscosity = 1e-2;  // m2/s
  constexpr int kFrames = 10;
  sim::Options options = fullSlab(resolution);
  options.viscosity = kViscosity * options.density;
  options.cfl = 0.5;
  options.frameRate = kFrames;
  sim::Solver solver = startedWith(options, [](const Vec3d& x) {
    return Vec3d(std::sin(2.0 * pi * x[0]) * std::cos(2.0 * pi * x[1]),
                 -std::cos(2.0 * pi * x[0]) * std::sin(2.0 * pi * x[1]), 0.0);
  });
  const auto energy = [&] {
    double sum = 0.0;
    const auto u = solver.state().u->getConstUnsafeAccessor(), v = solver.state().v->getConstUnsafeAccessor();
    for (int i = 0; i < resolution; ++i) {
      for (int j = 0; j < resolution; ++j)
        sum += std::pow(u.getValue(Coord(i, j, 4)), 2) + std::pow(v.getValue(Coord(i, j, 4)), 2);
    }
    return sum;
  };
  const double before = energy();
  for (int n = 0; n < kFrames; ++n) {
    solver.next();
    if (progress) progress((n + 1.0) / kFrames);
  }
  // The energy falls as exp(-16 pi^2 nu t).
  const double rate = -std::log(energy() / before) / (16.0 * pi * pi * (1.0 + solver.state().ahead));
  return {{{"taylor_green_viscous",
            resolution,
            "rate of decay, error, %",
            100.0 * (rate / kViscosity - 1.0),
            1.0,
            0.05,
            false,
            {},
            0.0}},
          {}};
}

struct CavityReference {
  double uMin, vMax, vMin;
};

// Converged extrema of the reference document: Richardson limits that meet Botella and Peyret's.
Result cavity(int reynolds, CavityReference reference, int resolution, const Progress& progress) {
  sim::Options options = fullSlab(resolution);
  options.viscosity = options.density / reynolds;
  options.cfl = 1.0;
  options.frameRate = 2.0;
  using sim::DomainFace;
  const sim::Wall still{.kind = sim::WallKind::noSlip};
  for (const DomainFace face : {DomainFace::xLow, DomainFace::xHigh, DomainFace::yLow})
    options.walls.push_back({face, still});
  options.walls.push_back(
      {DomainFace::yHigh, {.kind = sim::WallKind::noSlip, .velocity = Vec3d(1.0, 0.0, 0.0)}});
  sim::Solver solver(options);
  solver.next();

  const int middle = resolution / 2;
  // Extrema along the middle lines, by parabolas through three faces; steady when they no longer change.
  const auto extremum = [&](bool ofU, double sign) {
    const auto grid = (ofU ? solver.state().u : solver.state().v)->getConstUnsafeAccessor();
    const auto at = [&](int i) {
      return sign * grid.getValue(ofU ? Coord(middle, i, 4) : Coord(i, middle, 4));
    };
    int best = 1;
    for (int i = 1; i + 1 < resolution; ++i)
      if (at(i) > at(best)) best = i;
    const double below = at(best - 1), here = at(best), above = at(best + 1);
    const double bend = below - 2.0 * here + above;
    return sign * (here - (bend < 0.0 ? 0.125 * (above - below) * (above - below) / bend : 0.0));
  };
  double last = 0.0, u = 0.0;
  const int longest = 120 + reynolds / 5;
  int frames = 0;
  for (; frames < longest; ++frames) {
    solver.next();
    u = extremum(true, -1.0);
    if (progress) progress(double(frames) / longest);
    if (frames > 20 && std::abs(u - last) < 2e-6) break;
    last = u;
  }
  const std::string test = fmt::format("cavity_{}", reynolds);
  const double must = reynolds < 1000 ? 1.0 : 2.0;
  const auto row = [&](const char* name, double value, double exact) {
    Row r{test,
          resolution,
          fmt::format("{}, error, %", name),
          100.0 * (value / exact - 1.0),
          {},
          0.2,
          false,
          {{exact, "converged, m/s"}},
          0.0};
    if (resolution >= 128) r.must = must;
    return r;
  };
  Curve line{fmt::format("{} cells", resolution), {}, Curve::Style::line};
  const auto grid = solver.state().u->getConstUnsafeAccessor();
  for (int j = 0; j < resolution; ++j)
    line.points.push_back({(j + 0.5) / resolution, grid.getValue(Coord(middle, j, 4))});
  return {{row("least u", u, reference.uMin),
           row("most v", extremum(false, 1.0), reference.vMax),
           row("least v", extremum(false, -1.0), reference.vMin),
           {test, resolution, "time until steady, s", frames / options.frameRate, {}, {}, false, {}, 0.0}},
          {{fmt::format("{}_{}", test, resolution),
            fmt::format("Driven cavity, Re {}: u on the middle line", reynolds),
            "y (m)",
            "u (m/s)",
            false,
            false,
            {std::move(line)}}}};
}

// A disc that turns freely, or flies: friction must not feel it.
Result spinningDisc(int resolution, const Progress& progress) {
  constexpr double kRadius = 0.3, kNumber = 1e3;  // viscosity dt / (density h^2)
  constexpr int kFrames = 16;
  const double h = 1.0 / resolution, spin = 2.0 * pi, dt = h / (spin * kRadius);
  sim::Options options = fullSlab(resolution);
  options.frameRate = kFrames;
  options.cfl = 1.0;
  options.viscosity = kNumber * options.density * h * h / dt;
  const Vec3d middle(0.5, 0.5, 0.0), up(0.0, 0.0, 1.0);
  options.liquid[0].shape.kind = sim::Cylinder{middle - up, middle + up, kRadius};
  sim::Solver solver = startedWith(options, [&](const Vec3d& x) { return spin * up.cross(x - middle); });
  const auto momentum = [&] {
    const sim::State& state = solver.state();
    const auto phi = state.phi->getConstUnsafeAccessor(), u = state.u->getConstUnsafeAccessor(),
               v = state.v->getConstUnsafeAccessor();
    double sum = 0.0;
    for (int i = 0; i < resolution; ++i) {
      for (int j = 0; j < resolution; ++j) {
        const Coord c(i, j, 4);
        const double full = std::clamp(0.5 - phi.getValue(c) / h, 0.0, 1.0);
        const double speedU = 0.5 * (u.getValue(c) + u.getValue(c.offsetBy(1, 0, 0)));
        const double speedV = 0.5 * (v.getValue(c) + v.getValue(c.offsetBy(0, 1, 0)));
        sum += full * (((i + 0.5) * h - 0.5) * speedV - ((j + 0.5) * h - 0.5) * speedU);
      }
    }
    return sum;
  };
  const double before = momentum();
  for (int n = 0; n < kFrames; ++n) {
    solver.next();
    if (progress) progress((n + 1.0) / kFrames);
  }
  return {{{"spinning_disc",
            resolution,
            "angular momentum lost in a turn, %",
            100.0 * (1.0 - momentum() / before),
            1.0,
            0.01,
            false,
            {},
            0.0}},
          {}};
}

}  // namespace

std::vector<Case> viscousFlowCases() {
  std::vector<Case> list = {
      {"taylor_green_viscous",
       "viscous",
       "Taylor and Green's vortices with viscosity",
       {32, 64, 128},
       {},
       viscousVortices,
       {}},
      {"spinning_disc", "viscous", "A very viscous disc turns once", {32, 64}, {}, spinningDisc, {}}};
  const std::pair<int, CavityReference> cavities[] = {{100, {-0.21404, 0.17957, -0.25379}},
                                                      {400, {-0.32870, 0.30380, -0.45405}},
                                                      {1000, {-0.38849, 0.37686, -0.52706}}};
  for (const auto& [reynolds, reference] : cavities) {
    list.push_back(
        {fmt::format("cavity_{}", reynolds),
         "viscous",
         fmt::format("Driven cavity at Re {}", reynolds),
         {32, 64, 128},
         {},
         [reynolds = reynolds, reference = reference](int resolution, const Progress& progress) {
           return cavity(reynolds, reference, resolution, progress);
         },
         [](const std::vector<Row>& rows) { return orderRows(rows, "least u, error, %", 1.8, {}); }});
  }
  return list;
}

}  // namespace fluidtex::validation
