// Section A of the reference: shapes carried by known flows.
#include "tools/validation/level_set_cases.h"

#include "tools/validation/advection.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

namespace fluidtex::validation {
namespace {

using std::numbers::pi;

// Bars of one resolution: of the volume's change in percent, the symmetric difference in square or cubic
// metres, the same over the outline's length in cells, and the farthest point of the surface in cells.
struct Bar {
  std::optional<double> must, goal;
  std::vector<Published> published;
};
struct Bars {
  Bar volume = {}, difference = {}, length = {}, farthest = {};
};

Row makeRow(const std::string& test, int resolution, const std::string& measure, double value,
            const Bar& bar) {
  return {test, resolution, measure, value, bar.must, bar.goal, false, bar.published, 0.0};
}

Result rowsOf(const std::string& name, const AdvectionTest& test, int resolution, const Bars& bars,
              const Progress& progress) {
  const AdvectionResult r = run(test, resolution, progress);
  Result result;
  const std::string unit = test.slab ? "m2" : "m3";
  result.rows = {
      makeRow(name, resolution, "E_V, %", 100.0 * r.volumeError(), bars.volume),
      makeRow(name, resolution, "E_g, " + unit, r.difference, bars.difference),
      makeRow(name, resolution, "E_L1, 0.01 m", 100.0 * r.difference / test.surface, bars.length),
      makeRow(name, resolution, "E_inf, h", r.farthest * resolution, bars.farthest),
      makeRow(name, resolution, "E_g of the exact shape, " + unit, r.floor, {}),
      makeRow(name, resolution, "E_V half way, %", 100.0 * (r.volumeHalf / r.volumeBefore - 1.0), {}),
  };
  using enum Curve::Style;
  result.plots.push_back(
      {fmt::format("{}_{}", name, resolution),
       fmt::format("{}, {} cells: the surface before, half way and at the end", name, resolution),
       "x (m)",
       "y (m)",
       false,
       true,
       {{"before", r.before, segments}, {"half way", r.half, segments}, {"end", r.after, segments}}});
  return result;
}

Case advectionCase(std::string name, std::string title, AdvectionTest test, std::vector<int> resolutions,
                   std::vector<int> quick, std::map<int, Bars> bars) {
  Case c{name, "level_set", std::move(title), std::move(resolutions), std::move(quick), {}, {}};
  c.run = [name = std::move(name), test = std::move(test), bars = std::move(bars)](int resolution,
                                                                                   const Progress& progress) {
    const auto it = bars.find(resolution);
    return rowsOf(name, test, resolution, it != bars.end() ? it->second : Bars{}, progress);
  };
  return c;
}

const std::string kEnright = "particle level set, Enright et al. 2002";
const std::string kWeno = "WENO5 level set without markers or reinitialisation";
const std::string kIsoAdvector = "isoAdvector iso-alpha, TwoPhaseFlow";
const std::string kPlicRdf = "isoAdvector plicRDF, TwoPhaseFlow";

Case translation() {
  AdvectionTest test{
      circle(0.5, 0.5, 0.15), circle(1.5, 1.5, 0.15), sim::diagonal(), 2.0, 2.0, true, 0.3 * pi};
  return advectionCase("translation", "A circle moved by (1, 1)", test, {32, 64, 128}, {},
                       {{64, {.volume = {0.05, 0.005, {}}, .farthest = {0.1, 0.02, {}}}}});
}

Case zalesak(int turns) {
  AdvectionTest test{slottedDisk(), slottedDisk(), sim::rotation(), 1.0, 1.0, true, 1.43805};
  test.turns = turns;
  // Enright's lengths are in a domain of 100; 0.01 m of the unit square.
  std::map<int, Bars> bars;
  if (turns == 1) {
    bars[50] = {.volume = {{}, {}, {{-14.9, kEnright}, {-0.30, kWeno}}},
                .length = {{}, {}, {{0.58, kEnright}, {1.12, kWeno}}}};
    bars[100] = {.volume = {0.5, 0.05, {{-0.31, kEnright}, {-1.04, kWeno}}},
                 .length = {0.10, 0.05, {{0.07, kEnright}, {0.131, kWeno}, {0.14, "split PLIC, VOF guide"}}},
                 .farthest = {1.5, 1.0, {}}};
    bars[200] = {.volume = {{}, {}, {{-0.20, kEnright}, {0.07, kWeno}}},
                 .length = {{}, {}, {{0.02, kEnright}, {0.0366, kWeno}}}};
  }
  return advectionCase(turns == 1 ? "zalesak" : "zalesak_2",
                       turns == 1 ? "Zalesak's disk, one turn" : "Zalesak's disk, two turns", test,
                       turns == 1 ? std::vector{50, 100, 200} : std::vector{100},
                       turns == 1 ? std::vector{100} : std::vector<int>{}, std::move(bars));
}

Case zalesakSphere() {
  AdvectionTest test{slottedSphere(), slottedSphere(), sim::rotation(), 1.0, 1.0, false, 0.3433};
  test.sliceAt = 0.5;
  return advectionCase("zalesak_sphere", "A slotted sphere, one turn", test, {50, 100}, {},
                       {{100, {.volume = {1.0, 0.1, {}}}}});
}

Case vortex(double duration) {
  AdvectionTest test{circle(0.5, 0.75, 0.15),
                     circle(0.5, 0.75, 0.15),
                     sim::singleVortex(duration),
                     1.0,
                     1.0,
                     true,
                     0.3 * pi};
  if (duration < 3.0) {
    return advectionCase(
        "vortex_2", "The single vortex, T = 2", test, {64, 128, 256}, {},
        {{64, {.volume = {{}, {}, {{-0.78, kWeno}}}, .difference = {{}, {}, {{6.0e-4, kWeno}}}}},
         {128, {.volume = {0.2, {}, {{-0.085, kWeno}}}, .difference = {2e-4, {}, {{6.0e-5, kWeno}}}}},
         {256, {.volume = {{}, {}, {{-0.014, kWeno}}}, .difference = {{}, 1e-5, {{9.7e-6, kWeno}}}}}});
  }
  return advectionCase(
      "vortex_8", "The single vortex, T = 8", test, {64, 128, 256}, {},
      {{64,
        {.volume = {{}, 1.0, {{-1.8, kEnright}, {-90.0, kWeno}}},
         .difference = {{}, {}, {{9.4e-3, kIsoAdvector}, {8.2e-3, kPlicRdf}, {6.37e-2, kWeno}}},
         .length = {{}, {}, {{0.3, kEnright}}}}},
       {128,
        {.volume = {1.0, 0.05, {{-0.71, kEnright}, {-31.6, kWeno}}},
         .difference = {2.3e-3, 5e-4, {{1.47e-3, kIsoAdvector}, {2.33e-3, kPlicRdf}, {2.23e-2, kWeno}}},
         .length = {{}, {}, {{0.1, kEnright}}}}},
       {256,
        {.volume = {0.3, 0.02, {{-0.35, kEnright}, {-6.3, kWeno}}},
         .difference = {5.4e-4, 1e-4, {{4.3e-4, kIsoAdvector}, {5.4e-4, kPlicRdf}, {4.5e-3, kWeno}}},
         .length = {{}, {}, {{0.05, kEnright}}}}}});
}

Case deformation16() {
  // The vortices repeat every half metre; the domain is twice as high so that no liquid meets its ends.
  AdvectionTest test{
      circle(0.5, 1.25, 0.15), circle(0.5, 1.25, 0.15), sim::deformation2d(), 1.0, 2.0, true, 0.3 * pi};
  return advectionCase("deformation_2d", "Sixteen vortices, T = 2", test, {64, 128}, {},
                       {{128, {.volume = {2.0, 0.2, {}}}}});
}

// Of the unit square, which it does not leave; eddies down to a quarter of it, of speeds drawn by chance.
sim::KnownFlow randomFlow(double duration) {
  constexpr int kWaves = 4;
  std::array<std::array<double, kWaves>, kWaves> weight{};
  std::mt19937 random(20071);
  // Whole numbers are the same everywhere, distributions are not. Speeds of one size at every wave.
  for (int m = 0; m < kWaves; ++m)
    for (int n = 0; n < kWaves; ++n)
      weight[m][n] = 0.8 * (random() / 4294967296.0 - 0.5) / (pi * std::hypot(m + 1.0, n + 1.0));
  const auto potential = [weight](const Vec3d& x) {
    double sum = 0.0;
    for (int m = 0; m < kWaves; ++m)
      for (int n = 0; n < kWaves; ++n)
        sum += weight[m][n] * std::sin((m + 1) * pi * x[0]) * std::sin((n + 1) * pi * x[1]);
    return Vec3d(0.0, 0.0, sum);
  };
  return {potential, [duration](double t) { return std::cos(pi * t / duration); }, duration};
}

Case thereAndBack() {
  AdvectionTest test{
      circle(0.5, 0.5, 0.15), circle(0.5, 0.5, 0.15), randomFlow(4.0), 1.0, 1.0, true, 0.3 * pi};
  return advectionCase("random_flow", "A flow drawn by chance, there and back", test, {64, 128}, {}, {});
}

Case deformation() {
  const Distance ball = sphere(Vec3d(0.35), 0.15);
  AdvectionTest test{ball, ball, sim::deformation3d(), 1.0, 1.0, false, 0.09 * pi};
  return advectionCase(
      "deformation_3d", "The sphere of LeVeque and Enright, T = 3", test, {32, 64, 100, 128}, {},
      {{32, {.difference = {{}, {}, {{8.6e-3, kIsoAdvector}, {7.7e-3, kPlicRdf}}}}},
       {64,
        {.volume = {{}, {}, {{-57.5, kWeno}}},
         .difference = {{}, {}, {{3.4e-3, kIsoAdvector}, {3.1e-3, kPlicRdf}, {8.1e-3, kWeno}}}}},
       {100,
        {.volume = {3.0, 0.5, {{-2.6, kEnright}, {-34.8, kWeno}}},
         .difference = {{}, {}, {{4.9e-3, kWeno}}}}},
       {128,
        {.volume = {2.0, 0.1, {}},
         .difference = {1.0e-3, 5e-4, {{5.4e-4, kIsoAdvector}, {7.0e-4, kPlicRdf}}}}}});
}

}  // namespace

std::vector<Case> levelSetCases() {
  return {translation(), zalesak(1),      zalesak(2),     zalesakSphere(), vortex(2.0),
          vortex(8.0),   deformation16(), thereAndBack(), deformation()};
}

}  // namespace fluidtex::validation
