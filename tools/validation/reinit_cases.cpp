// Section A.4 of the reference: making phi a distance without moving the surface.
#include "tools/validation/reinit_cases.h"

#include "sim/surface/level_set.h"
#include "sim/surface/redistance.h"
#include "tools/validation/measure.h"
#include "tools/validation/order.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fluidtex::validation {
namespace {

using sim::Coord;
using sim::kLeafDim;
using sim::kLeafSize;

// Wide enough to hold values of slopes far above 1.
constexpr int kBand = 500;

// A slab of one leaf along z, without solids, that holds `value` at the centres of its cells; world positions
// start at the origin. One more layer of leaves around it.
sim::FloatGrid::Ptr slabOf(const Distance& value, int cells, double h) {
  sim::FloatGrid::Ptr phi = sim::makePhi(h, kBand * h);
  const float background = phi->background();
  for (int i = -kLeafDim; i < cells + kLeafDim; i += kLeafDim) {
    for (int j = -kLeafDim; j < cells + kLeafDim; j += kLeafDim) {
      for (int k = -kLeafDim; k <= kLeafDim; k += kLeafDim) {
        sim::FloatLeaf* leaf = phi->tree().touchLeaf(Coord(i, j, k));
        for (int n = 0; n < kLeafSize; ++n) {
          const Vec3d x = phi->indexToWorld(leaf->offsetToGlobalCoord(n));
          leaf->setValueOnly(n, std::clamp(static_cast<float>(value(x)), -background, background));
        }
      }
    }
  }
  return phi;
}

// The same values in every layer, as far as the stencils reach.
Distance upright(const Distance& plane) {
  return [plane](const Vec3d& x) { return plane(Vec3d(x[0], x[1], 0.0)); };
}

sim::FloatGrid::Ptr noSolid(double h) {
  return sim::makePhi(h, 3.0 * h);
}

// The layers above and below the slab's own take over what its middle has, so that the problem stays plane.
void level(sim::FloatGrid& phi) {
  for (sim::FloatLeaf* leaf : sim::leavesOf(phi.tree())) {
    const Coord origin = leaf->origin();
    if (origin[2] == 0) continue;
    const sim::FloatLeaf* middle = phi.constTree().probeConstLeaf(Coord(origin[0], origin[1], 0));
    for (int n = 0; n < kLeafSize; ++n) leaf->setValueOnly(n, middle->getValue((n & ~7) | (kLeafDim / 2)));
  }
}

void reinitializeOften(sim::FloatGrid& phi, int calls, const Progress& progress) {
  const auto solid = noSolid(phi.voxelSize()[0]);
  for (int n = 0; n < calls; ++n) {
    sim::redistance(phi, *solid);
    level(phi);
    if (progress) progress((n + 1.0) / calls);
  }
}

// How far the surface's crossings of grid lines in the slab's middle are from one another, at most, in cells.
double displacement(const sim::FloatGrid& a, const sim::FloatGrid& b, int cells) {
  const auto first = a.getConstUnsafeAccessor(), second = b.getConstUnsafeAccessor();
  double most = 0.0;
  for (int i = 0; i + 1 < cells; ++i) {
    for (int j = 0; j + 1 < cells; ++j) {
      const Coord from(i, j, kLeafDim / 2);
      for (const Coord& to : {from.offsetBy(1, 0, 0), from.offsetBy(0, 1, 0)}) {
        const double p = first.getValue(from), q = first.getValue(to);
        const double r = second.getValue(from), s = second.getValue(to);
        const bool cutFirst = (p < 0.0) != (q < 0.0), cutSecond = (r < 0.0) != (s < 0.0);
        if (cutFirst && cutSecond) most = std::max(most, std::abs(p / (p - q) - r / (r - s)));
        // The crossing went past a cell centre.
        if (cutFirst != cutSecond)
          most = std::max(most, std::min(std::abs(r), std::abs(s)) / std::abs(s - r));
      }
    }
  }
  return most;
}

// Distance to the ellipse (x/a)^2 + (y/b)^2 = 1, negative inside: Newton's method on the angle of the nearest
// point.
double toEllipse(double x, double y, double a, double b) {
  x = std::abs(x), y = std::abs(y);
  double angle = std::atan2(a * y, b * x);
  for (int n = 0; n < 50; ++n) {
    const double c = std::cos(angle), s = std::sin(angle);
    const double slope = a * x * s - b * y * c - (a * a - b * b) * s * c;
    const double curve = a * x * c + b * y * s - (a * a - b * b) * (c * c - s * s);
    if (curve <= 0.0) break;
    const double step = slope / curve;
    angle = std::clamp(angle - step, 0.0, 0.5 * std::numbers::pi);
    if (std::abs(step) < 1e-15) break;
  }
  const double distance = std::hypot(x - a * std::cos(angle), y - b * std::sin(angle));
  return x * x / (a * a) + y * y / (b * b) < 1.0 ? -distance : distance;
}

struct BandError {
  double mean = 0.0, rms = 0.0, most = 0.0;
};

// Of phi against the distance, at the cells of one layer closer to the surface than `width`.
BandError bandError(const sim::FloatGrid& phi, const Distance& exact, int cells, double width) {
  BandError error;
  int count = 0;
  const auto value = phi.getConstUnsafeAccessor();
  for (int i = 0; i < cells; ++i) {
    for (int j = 0; j < cells; ++j) {
      const Coord cell(i, j, kLeafDim / 2);
      const double right = exact(phi.indexToWorld(cell));
      if (std::abs(right) >= width) continue;
      const double off = std::abs(value.getValue(cell) - right);
      error.mean += off;
      error.rms += off * off;
      error.most = std::max(error.most, off);
      ++count;
    }
  }
  error.mean /= count;
  error.rms = std::sqrt(error.rms / count);
  return error;
}

// The ellipse of Russo and Smereka: a field that is far from a distance, steep on one side and flat on the
// other.
Result ellipse(int resolution, const Progress& progress) {
  constexpr double kSize = 10.0, kA = 4.0, kB = 2.0;
  const double h = kSize / resolution;
  const auto field = [](const Vec3d& x) {
    const double X = x[0] - 0.5 * kSize, Y = x[1] - 0.5 * kSize;
    const double f = 0.1 + (X - 3.5) * (X - 3.5) + (Y - 2.0) * (Y - 2.0);
    return f * (std::hypot(X / kA, Y / kB) - 1.0);
  };
  const auto distance = [](const Vec3d& x) {
    return toEllipse(x[0] - 0.5 * kSize, x[1] - 0.5 * kSize, kA, kB);
  };
  const auto solid = noSolid(h);
  auto phi = slabOf(upright(field), resolution, h);
  sim::redistance(*phi, *solid, 2 * resolution);
  const BandError error = bandError(*phi, distance, resolution, 1.2 * h);
  level(*phi);
  const sim::FloatGrid::Ptr once = phi->deepCopy();
  reinitializeOften(*phi, 99, progress);

  std::optional<double> must, goal;
  std::vector<Published> mean, most;
  const std::string source = "Basilisk redistance-ellipse";
  const auto bars = [&](double basilisk, double largest) {
    must = 2.0 * basilisk;
    goal = basilisk;
    mean = {{basilisk, source}};
    most = {{largest, source}};
  };
  if (resolution == 64) bars(1.52e-4, 1.23e-3);
  if (resolution == 128) bars(1.71e-5, 1.55e-4);
  if (resolution == 256) bars(2.44e-6, 1.91e-5);
  const std::string test = "reinit_ellipse";
  Result result;
  result.rows = {{test, resolution, "band mean, m", error.mean, must, goal, false, mean, 0.0},
                 {test, resolution, "band max, m", error.most, {}, {}, false, most, 0.0},
                 {test,
                  resolution,
                  "moved after 100 calls, h",
                  displacement(*once, *phi, resolution),
                  0.01,
                  {},
                  false,
                  {},
                  0.0}};
  return result;
}

// A circle made a distance a thousand times.
Result circleKept(int resolution, const Progress& progress) {
  const double h = 1.0 / resolution;
  const Distance shape = circle(0.25, 0.25, 0.15);
  // Half a metre is enough around it.
  const int side = resolution / 2;
  const Coord cells(side, side, kLeafDim), samples(10, 10, 2);
  auto phi = slabOf(upright(shape), side, h);
  const double before = compare(*phi, shape, cells, samples).volume;
  reinitializeOften(*phi, 1, {});
  const double once = compare(*phi, shape, cells, samples).volume;
  reinitializeOften(*phi, 999, progress);
  const double after = compare(*phi, shape, cells, samples).volume;
  const std::string test = "reinit_circle";
  Result result;
  result.rows = {
      {test, resolution, "area change, 1 call, %", 100.0 * (once / before - 1.0), {}, 1e-4, false, {}, 0.0},
      {test,
       resolution,
       "area change, 1000 calls, %",
       100.0 * (after / before - 1.0),
       0.1,
       1e-4,
       false,
       {},
       0.0}};
  return result;
}

// Zalesak's disk, whose corners no smooth interpolation holds.
Result cornersKept(int resolution, const Progress& progress) {
  const double h = 1.0 / resolution;
  const Distance shape = slottedDisk();
  const Coord cells(resolution, resolution, kLeafDim), samples(10, 10, 2);
  auto phi = slabOf(upright(shape), resolution, h);
  const ShapeError before = compare(*phi, shape, cells, samples);
  const auto outlineBefore = outline(*phi, cells, kLeafDim / 2);
  reinitializeOften(*phi, 100, progress);
  const ShapeError after = compare(*phi, shape, cells, samples);
  const std::string test = "reinit_corners";
  Result result;
  result.rows = {{test, resolution, "moved after 100 calls, h", after.farthest / h, 0.5, {}, false, {}, 0.0},
                 {test,
                  resolution,
                  "area change, 100 calls, %",
                  100.0 * (after.volume / before.volume - 1.0),
                  {},
                  {},
                  false,
                  {},
                  0.0}};
  using enum Curve::Style;
  result.plots = {
      {test + "_" + std::to_string(resolution),
       "Zalesak's disk made a distance 100 times",
       "x (m)",
       "y (m)",
       false,
       true,
       {{"before", outlineBefore, segments}, {"after", outline(*phi, cells, kLeafDim / 2), segments}}}};
  return result;
}

// Two circles three cells apart: the gap must not close.
Result gapKept(int resolution, const Progress& progress) {
  const double h = 1.0 / resolution, radius = 0.15, gap = 3.0 * h;
  const Distance left = circle(0.5 - radius - 0.5 * gap, 0.5, radius),
                 right = circle(0.5 + radius + 0.5 * gap, 0.5, radius);
  const Distance both = [=](const Vec3d& x) { return std::min(left(x), right(x)); };
  const Coord cells(resolution, resolution, kLeafDim);
  auto phi = slabOf(upright(both), resolution, h);
  reinitializeOften(*phi, 100, progress);
  const ShapeError after = compare(*phi, both, cells, Coord(4, 4, 2));
  const double middle =
      phi->getConstUnsafeAccessor().getValue(Coord(resolution / 2, resolution / 2, kLeafDim / 2));
  const std::string test = "reinit_gap";
  Result result;
  result.rows = {{test, resolution, "moved after 100 calls, h", after.farthest / h, 0.5, 0.1, false, {}, 0.0},
                 {test, resolution, "phi in the gap, h", middle / h, 1.0, 1.4, true, {}, 0.0}};
  return result;
}

}  // namespace

std::vector<Case> reinitCases() {
  Case first{"reinit_ellipse", "level_set", "Russo and Smereka's ellipse", {64, 128, 256}, {64}, ellipse, {}};
  first.summarize = [](const std::vector<Row>& rows) { return orderRows(rows, "band mean, m", 2.0, 3.0); };
  return {first,
          {"reinit_circle", "level_set", "A circle made a distance 1000 times", {64}, {64}, circleKept, {}},
          {"reinit_corners",
           "level_set",
           "Zalesak's disk made a distance 100 times",
           {100},
           {100},
           cornersKept,
           {}},
          {"reinit_gap", "level_set", "Two circles three cells apart", {64}, {64}, gapKept, {}}};
}

}  // namespace fluidtex::validation
