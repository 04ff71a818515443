#include "tools/validation/sheet_cases.h"

#include "sim/step/solver.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fluidtex::validation {
namespace {

using sim::Coord;
using sim::Vec3d;

constexpr double kCell = 0.01;  // m
constexpr int kWidth = 16;      // cells across, between two sides of symmetry
constexpr int kFrames = 60;
// Of what is measured, in cells.
constexpr double kSmooth = 0.01;

// A column of cells along an axis: where the surface is on its upper side and on its lower one, in cells.
struct Faces {
  double upper = 0.0, lower = 0.0;
};

Faces facesOf(const sim::State& state, int x, int y, int height) {
  const auto phi = state.phi->getConstAccessor();
  const auto at = [&](int z) { return double(phi.getValue(Coord(x, y, z))); };
  Faces faces;
  int z = height - 1;
  while (z > 0 && at(z) >= 0.0) --z;
  faces.upper = z + 0.5 + at(z) / (at(z) - at(z + 1));
  while (z >= 0 && at(z) < 0.0) --z;
  if (z >= 0) faces.lower = z + 0.5 + at(z) / (at(z) - at(z + 1));
  return faces;
}

// What is measured of columns from x = first to last: the rms distance of a face from its mean across the
// sheet, in cells, the worse of the two faces, and the mean thickness of each x.
struct Sheet {
  double roughness = 0.0;
  std::vector<double> thickness;
};

Sheet measured(const sim::State& state, int first, int last, int height) {
  Sheet sheet;
  double squares[2] = {0.0, 0.0};
  for (int x = first; x <= last; ++x) {
    double sum[2] = {0.0, 0.0}, square[2] = {0.0, 0.0};
    for (int y = 0; y < kWidth; ++y) {
      const Faces faces = facesOf(state, x, y, height);
      sum[0] += faces.upper, square[0] += faces.upper * faces.upper;
      sum[1] += faces.lower, square[1] += faces.lower * faces.lower;
    }
    for (int face = 0; face < 2; ++face)
      squares[face] += square[face] / kWidth - std::pow(sum[face] / kWidth, 2);
    sheet.thickness.push_back((sum[0] - sum[1]) / kWidth);
  }
  sheet.roughness = std::sqrt(std::max({squares[0], squares[1], 0.0}) / (last - first + 1));
  return sheet;
}

// The thickness that a sheet of thickness `thick` at speed `speed` has where it has gained the energy
// `gained` (m2/s2), of a liquid without friction that `press` (m/s2) presses on its floor: conservation of
// flux and of energy, by Newton's method for the speed.
double thicknessAfter(double thick, double speed, double gained, double press) {
  const double flux = thick * speed, energy = 0.5 * speed * speed + press * thick + gained;
  double u = std::sqrt(speed * speed + 2.0 * gained);
  for (int n = 0; n < 20; ++n) u -= (0.5 * u * u + press * flux / u - energy) / (u - press * flux / (u * u));
  return flux / u;
}

// A sheet comes out of a source along x, in which gravity draws it on, at an angle to the horizontal; below
// 90 degrees it slides on a floor.
Result moving(const std::string& test, double angle, int cells, const Progress& progress) {
  constexpr int kLength = 56, kHeight = 24;
  constexpr double kSpeed = 2.0, kSource = 4.0;  // m/s; cells
  const bool slides = angle < 90.0;
  const double along = kGravity * std::sin(angle * std::numbers::pi / 180.0),
               press = slides ? kGravity * std::cos(angle * std::numbers::pi / 180.0) : 0.0;
  // Between the middles of cells, neither on a face nor half way.
  const double below = slides ? 0.0 : 8.24, above = below + cells;
  sim::Options options;
  options.size = kCell * Vec3d(kLength, kWidth, kHeight);
  options.resolution = kLength;
  options.gravity = Vec3d(along, 0.0, -press);
  options.viscosity = 0.0;
  options.cfl = 2.0;
  options.sides[1] = sim::Side::open;
  options.sides[2] = options.sides[3] = sim::Side::symmetry;
  sim::Source source;
  source.shape = {
      sim::Box{Vec3d(-1.0, -1.0, slides ? -1.0 : below * kCell), Vec3d(kSource * kCell, 1.0, above * kCell)}};
  source.velocity = Vec3d(kSpeed, 0.0, 0.0);
  options.sources = {source};
  sim::Solver solver(options);
  for (int n = 1; n <= kFrames; ++n) {
    solver.next();
    if (progress) progress(double(n) / kFrames);
  }
  const int first = kLength / 4, last = 3 * kLength / 4;
  const Sheet sheet = measured(solver.state(), first, last, kHeight);
  double worst = 0.0;
  for (int x = first; x <= last; ++x) {
    const double exact =
        thicknessAfter(cells * kCell, kSpeed, along * (x + 0.5 - kSource) * kCell, press) / kCell;
    worst = std::max(worst, std::abs(sheet.thickness[std::size_t(x - first)] - exact));
  }
  return {{row(test, cells, "roughness, cells rms", sheet.roughness, kSmooth, 1e-3),
           row(test, cells, "thickness off, worst in the middle half, cells", worst, {}, 0.05)},
          {}};
}

Result falling(int cells, const Progress& progress) {
  return moving("sheet_falling", 90.0, cells, progress);
}

Result sliding(int cells, const Progress& progress) {
  return moving("sheet_sliding", 30.0, cells, progress);
}

// A very viscous block collapses in a tank and comes to rest with its surface between the middles of cells.
Result resting(int cells, const Progress& progress) {
  constexpr int kLength = 32, kHeight = 24;
  const double depth = cells + 0.3;
  sim::Options options;
  options.size = kCell * Vec3d(kLength, kWidth, kHeight);
  options.resolution = kLength;
  options.viscosity = 20.0;
  options.cfl = 2.0;
  options.sides[2] = options.sides[3] = sim::Side::symmetry;
  options.liquid = {{{sim::Box{Vec3d(0.0), kCell * Vec3d(kLength / 4, kWidth, 4.0 * depth)}}}};
  sim::Solver solver(options);
  for (int n = 1; n <= kFrames; ++n) {
    solver.next();
    if (progress) progress(double(n) / kFrames);
  }
  const Sheet sheet = measured(solver.state(), kLength / 4, 3 * kLength / 4, kHeight);
  double worst = 0.0;
  for (const double thickness : sheet.thickness) worst = std::max(worst, std::abs(thickness - depth));
  const std::string test = "sheet_resting";
  return {{row(test, cells, "roughness, cells rms", sheet.roughness, kSmooth, 1e-3),
           row(test, cells, "depth off, worst in the middle half, cells", worst, {}, 0.05)},
          {}};
}

}  // namespace

std::vector<Case> sheetCases() {
  return {
      {"sheet_falling", "fluid", "A sheet that falls; cells to its thickness", {2, 3, 4}, {3}, falling, {}},
      {"sheet_sliding",
       "stream",
       "A sheet that slides down an incline; cells to its thickness",
       {2, 3, 4},
       {},
       sliding,
       {}},
      {"sheet_resting",
       "fluid",
       "A sheet that has come to rest; cells to its depth",
       {2, 3, 4},
       {},
       resting,
       {}}};
}

}  // namespace fluidtex::validation
