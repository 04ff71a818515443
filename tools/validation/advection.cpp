#include "tools/validation/advection.h"

#include "sim/flows/move_surface.h"
#include "sim/solids/solids.h"
#include "sim/surface/level_set.h"

#include <cmath>

namespace fluidtex::validation {
namespace {

using sim::Coord;

// A slab's layers, and those in its middle that are measured: nearer to the walls distances are made another
// way.
constexpr int kSlab = 2 * sim::kLeafDim, kFirst = 6, kLast = 9;

double largestDivergence(const sim::Velocity& velocity, const Coord& cells) {
  double largest = 0.0;
  const auto u = velocity.component[0]->getConstUnsafeAccessor(),
             v = velocity.component[1]->getConstUnsafeAccessor(),
             w = velocity.component[2]->getConstUnsafeAccessor();
  for (int i = 0; i < cells[0]; ++i)
    for (int j = 0; j < cells[1]; ++j)
      for (int k = 0; k < cells[2]; ++k) {
        const Coord c(i, j, k);
        const double sum = double(u.getValue(c.offsetBy(1, 0, 0))) - u.getValue(c) +
                           v.getValue(c.offsetBy(0, 1, 0)) - v.getValue(c) + w.getValue(c.offsetBy(0, 0, 1)) -
                           w.getValue(c);
        largest = std::max(largest, std::abs(sum));
      }
  return largest / sim::maxAbs(velocity);
}

}  // namespace

AdvectionResult run(const AdvectionTest& test, int resolution, const Progress& progress) {
  const double h = 1.0 / resolution;
  sim::Options options;
  options.size = Vec3d(test.width, test.height, test.slab ? kSlab * h : 1.0);
  options.resolution = static_cast<int>(std::lround(std::max(test.width, test.height) * resolution));
  sim::Solids solids(options);
  const auto solid = solids.at(0.0);
  const Coord cells = solid->domain.dim();
  constexpr int kBand = 6, kMargin = sim::kLeafDim;

  sim::FloatGrid::Ptr phi = sim::makePhi(h, kBand * h);
  sim::unite(*phi, test.start, sim::grown(sim::firstCells(cells), kMargin));
  sim::trimBand(*phi, *solid->phi);
  sim::Markers markers = sim::seedMarkers(*phi, *solid->phi, 0);

  const sim::Velocity flow = sim::faceVelocity(test.flow, cells, kMargin, h);
  sim::Velocity velocity = sim::faceVelocity(test.flow, cells, kMargin, h);
  const double speed = sim::maxAbs(flow), duration = test.flow.duration * test.turns;
  const int steps = static_cast<int>(std::ceil(duration * speed / (test.cfl * h)));
  const double dt = duration / steps;

  const Coord samples = test.slab ? Coord(10, 10, 2) : Coord(4);
  // A slab's measures are areas.
  const double unit = test.slab ? (kLast - kFirst) * h : 1.0;
  const Coord measured = test.slab ? Coord(cells[0], cells[1], kLast + 1) : cells;
  const Coord firstMeasured(0, 0, test.slab ? kFirst : 0);
  const auto errorOf = [&](const Distance& exact) {
    return compare(*phi, exact, measured, samples, firstMeasured);
  };
  const int slice = test.slab ? kSlab / 2 : static_cast<int>(test.sliceAt * resolution);

  AdvectionResult result;
  result.steps = steps;
  result.divergence = largestDivergence(flow, cells);
  const ShapeError first = errorOf(test.start);
  result.volumeBefore = first.volume / unit;
  result.floor = first.difference / unit;
  result.farthestBefore = first.farthest;
  result.before = outline(*phi, cells, slice);
  for (int n = 0; n < steps; ++n) {
    // The flow in the middle of the step: second order in time.
    sim::scale(flow, test.flow.strength((n + 0.5) * dt), velocity);
    sim::moveSurface(*phi, markers, {velocity, *solid, dt, static_cast<std::uint64_t>(n) + 1});
    if (n + 1 == (steps + 1) / 2) {
      result.volumeHalf = errorOf(test.start).volume / unit;
      result.half = outline(*phi, cells, slice);
    }
    if (progress) progress((n + 1.0) / steps);
  }
  const ShapeError last = errorOf(test.end);
  result.volumeAfter = last.volume / unit;
  result.difference = last.difference / unit;
  result.farthest = last.farthest;
  result.after = outline(*phi, cells, slice);
  return result;
}

}  // namespace fluidtex::validation
