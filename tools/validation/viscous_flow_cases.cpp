// Sections C.1, C.2 and C.9 of the reference: the whole solver where friction matters.
#include "tools/validation/viscous_cases.h"

#include "tools/validation/order.h"
#include "tools/validation/solver_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
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
  options.sides[4] = options.sides[5] = sim::Side::symmetry;
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
    const auto u = solver.state().velocity.component[0]->getConstUnsafeAccessor(),
               v = solver.state().velocity.component[1]->getConstUnsafeAccessor();
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
  const double rate = -std::log(energy() / before) / (16.0 * pi * pi * (1.0 + solver.state().leapfrogOffset));
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

sim::Options cavityOptions(int reynolds, int resolution) {
  sim::Options options = fullSlab(resolution);
  options.viscosity = options.density / reynolds;
  // Steady in the end: what a step's interpolation loses is lost three times as seldom as with a number of 1.
  options.cfl = 3.0;
  options.frameRate = 2.0;
  using sim::DomainFace;
  const sim::Wall still{.kind = sim::WallKind::noSlip};
  for (const DomainFace face : {DomainFace::xLow, DomainFace::xHigh, DomainFace::yLow})
    options.walls.push_back({face, still});
  options.walls.push_back(
      {DomainFace::yHigh, {.kind = sim::WallKind::noSlip, .velocity = Vec3d(1.0, 0.0, 0.0)}});
  return options;
}

// Velocity of a state between its faces in the domain's plane; nothing changes across the slab.
std::function<Vec3d(const Vec3d&)> interpolated(const sim::State& state) {
  const auto sampled = [](const sim::FloatGrid& grid, const Vec3d& x) {
    const Vec3d at = grid.worldToIndex(x);
    const Vec3d low(std::floor(at[0]), std::floor(at[1]), 4.0), t = at - low;
    const auto value = [&](int i, int j) {
      return static_cast<double>(grid.tree().getValue(Coord(int(low[0]) + i, int(low[1]) + j, 4)));
    };
    return (1.0 - t[0]) * ((1.0 - t[1]) * value(0, 0) + t[1] * value(0, 1)) +
           t[0] * ((1.0 - t[1]) * value(1, 0) + t[1] * value(1, 1));
  };
  return [=, u = state.velocity.component[0], v = state.velocity.component[1]](const Vec3d& x) {
    return Vec3d(sampled(*u, x), sampled(*v, x), 0.0);
  };
}

// Extremum of u (or v) along the middle line, by a parabola through three faces.
double extremum(const sim::State& state, int resolution, bool ofU, double sign) {
  const int middle = resolution / 2;
  const auto grid =
      (ofU ? state.velocity.component[0] : state.velocity.component[1])->getConstUnsafeAccessor();
  const auto at = [&](int i) {
    return sign * grid.getValue(ofU ? Coord(middle, i, 4) : Coord(i, middle, 4));
  };
  int best = 1;
  for (int i = 1; i + 1 < resolution; ++i)
    if (at(i) > at(best)) best = i;
  const double below = at(best - 1), here = at(best), above = at(best + 1);
  const double bend = below - 2.0 * here + above;
  return sign * (here - (bend < 0.0 ? 0.125 * (above - below) * (above - below) / bend : 0.0));
}

// Runs until least u changes by less than `change` a second, m/s, over two seconds; gives how long it took.
double runUntilSteady(sim::Solver& solver, double frameRate, int resolution, int reynolds, double change,
                      const Progress& progress) {
  const int longest = static_cast<int>((60.0 + 0.1 * reynolds) * frameRate);
  constexpr double kWatched = 2.0;
  std::vector<double> least;
  for (int n = 1; n <= longest; ++n) {
    solver.next();
    least.push_back(extremum(solver.state(), resolution, true, -1.0));
    if (progress) progress(double(n) / longest);
    const auto watched = static_cast<std::size_t>(kWatched * frameRate);
    if (least.size() <= 3 * watched) continue;
    const auto [low, high] = std::minmax_element(least.end() - watched, least.end());
    if (*high - *low < kWatched * change) return n / frameRate;
  }
  return longest / frameRate;
}

// Converged extrema of the reference document: Richardson limits that meet Botella and Peyret's; and u on
// the middle line at multiples of 1/128.
struct CavityReference {
  double uMin, vMax, vMin;
  std::array<double, 15> u, v;
};

constexpr int kLineU[] = {7, 8, 9, 13, 22, 36, 58, 64, 79, 94, 109, 122, 123, 124, 125};
constexpr int kLineV[] = {8, 9, 10, 12, 20, 29, 30, 64, 103, 110, 116, 121, 122, 123, 124};

Result cavity(int reynolds, const CavityReference& reference, int resolution, const Progress& progress) {
  // From the steady flow on half as fine a grid, and so on: only what that grid has got wrong has to settle.
  constexpr int kCoarsest = 32;
  constexpr double kChange = 2e-5;
  std::vector<int> grids{resolution};
  while (grids.back() % 2 == 0 && grids.back() / 2 >= kCoarsest) grids.push_back(grids.back() / 2);
  std::reverse(grids.begin(), grids.end());
  const sim::Options first = cavityOptions(reynolds, grids.front());
  sim::Solver solver(first);
  solver.next();
  double time = runUntilSteady(solver, first.frameRate, grids.front(), reynolds, kChange, progress);
  for (std::size_t n = 1; n < grids.size(); ++n) {
    const sim::Options options = cavityOptions(reynolds, grids[n]);
    solver = startedWith(options, interpolated(solver.state()));
    time = runUntilSteady(solver, options.frameRate, grids[n], reynolds, kChange, progress);
  }
  const auto field = interpolated(solver.state());
  double off = 0.0;
  for (std::size_t n = 0; n < reference.u.size(); ++n) {
    off = std::max(off, std::abs(field(Vec3d(0.5, kLineU[n] / 128.0, 0.0))[0] - reference.u[n]));
    off = std::max(off, std::abs(field(Vec3d(kLineV[n] / 128.0, 0.5, 0.0))[1] - reference.v[n]));
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
  Row table{test, resolution, "farthest from the tables' rows, m/s", off, {}, {}, false, {}, 0.0};
  if (resolution >= 128) table.must = 0.01;
  Curve line{fmt::format("{} cells", resolution), {}, Curve::Style::line},
      converged{"converged", {}, Curve::Style::marks};
  for (int j = 0; j < resolution; ++j) {
    const double y = (j + 0.5) / resolution;
    line.points.push_back({y, field(Vec3d(0.5, y, 0.0))[0]});
  }
  for (std::size_t n = 0; n < reference.u.size(); ++n)
    converged.points.push_back({kLineU[n] / 128.0, reference.u[n]});
  const sim::State& state = solver.state();
  return {{row("least u", extremum(state, resolution, true, -1.0), reference.uMin),
           row("most v", extremum(state, resolution, false, 1.0), reference.vMax),
           row("least v", extremum(state, resolution, false, -1.0), reference.vMin),
           table,
           {test, resolution, "time until steady, s", time, {}, {}, false, {}, 0.0}},
          {{fmt::format("{}_{}", test, resolution),
            fmt::format("Driven cavity, Re {}: u on the middle line", reynolds),
            "y (m)",
            "u (m/s)",
            false,
            false,
            {std::move(line), std::move(converged)}}}};
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
    const auto phi = state.phi->getConstUnsafeAccessor(),
               u = state.velocity.component[0]->getConstUnsafeAccessor(),
               v = state.velocity.component[1]->getConstUnsafeAccessor();
    double sum = 0.0;
    for (int n = 0; n < resolution * resolution * 8; ++n) {
      const Coord c(n / 8 / resolution, n / 8 % resolution, n % 8);
      const double full = std::clamp(0.5 - phi.getValue(c) / h, 0.0, 1.0);
      const double speedU = 0.5 * (u.getValue(c) + u.getValue(c.offsetBy(1, 0, 0)));
      const double speedV = 0.5 * (v.getValue(c) + v.getValue(c.offsetBy(0, 1, 0)));
      sum += full * (((c[0] + 0.5) * h - 0.5) * speedV - ((c[1] + 0.5) * h - 0.5) * speedU);
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
  const std::pair<int, CavityReference> cavities[] = {
      {100,
       {-0.21404,
        0.17957,
        -0.25379,
        {-0.0372, -0.0420, -0.0466, -0.0644, -0.1017, -0.1576, -0.2140, -0.2091, -0.1388, 0.0041, 0.2364,
         0.6912, 0.7407, 0.7916, 0.8435},
        {0.0948, 0.1036, 0.1118, 0.1264, 0.1648, 0.1793, 0.1796, 0.0575, -0.2535, -0.2337, -0.1772, -0.1085,
         -0.0933, -0.0779, -0.0623}}},
      {400,
       {-0.32870,
        0.30380,
        -0.45405,
        {-0.0818, -0.0926, -0.1033, -0.1461, -0.2437, -0.3287, -0.1714, -0.1150, 0.0210, 0.1625, 0.2920,
         0.5617, 0.6201, 0.6867, 0.7602},
        {0.1851, 0.1988, 0.2110, 0.2316, 0.2835, 0.3038, 0.3034, 0.0521, -0.3856, -0.4538, -0.3898, -0.2346,
         -0.1981, -0.1614, -0.1254}}},
      {1000,
       {-0.38849,
        0.37686,
        -0.52706,
        {-0.1812, -0.2023, -0.2229, -0.3003, -0.3885, -0.2804, -0.1081, -0.0620, 0.0570, 0.1886, 0.3371,
         0.4723, 0.5170, 0.5802, 0.6638},
        {0.2806, 0.2962, 0.3099, 0.3329, 0.3768, 0.3340, 0.3253, 0.0258, -0.3201, -0.4263, -0.5264, -0.4102,
         -0.3551, -0.2933, -0.2283}}}};
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
