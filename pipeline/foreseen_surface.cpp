#include "pipeline/foreseen_surface.h"

#include "pipeline/liquid_plan.h"
#include "sim/grid/mac_grid.h"
#include "sim/shapes/shape_distance.h"
#include "sim/solids/domain.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace fluidtex::pipeline {
namespace {

using openvdb::Coord;
using sim::Vec3d;

// Axis nearest to gravity; z without gravity.
int upAxis(const sim::Options& options) {
  int up = 2;
  for (int a = 0; a < 2; ++a)
    if (std::abs(options.gravity[a]) > std::abs(options.gravity[up])) up = a;
  return up;
}

// Per axis, faces of the source's cells (centres inside it) that `velocity` leaves through.
std::array<double, 3> frontFaces(const sim::ShapeDistance& shape, const openvdb::CoordBBox& cells, double h,
                                 const Vec3d& velocity) {
  using Counts = std::array<double, 3>;
  const auto inside = [&](const Coord& cell) {
    return cells.isInside(cell) && shape(h * (cell.asVec3d() + Vec3d(0.5))) < 0.0;
  };
  const auto sum = [](const Counts& a, const Counts& b) {
    return Counts{a[0] + b[0], a[1] + b[1], a[2] + b[2]};
  };
  // Whole numbers: the order of the sum does not matter.
  return tbb::parallel_reduce(
      tbb::blocked_range<int>(cells.min()[0], cells.max()[0] + 1), Counts{},
      [&](const tbb::blocked_range<int>& range, Counts count) {
        for (int i = range.begin(); i < range.end(); ++i) {
          for (int j = cells.min()[1]; j <= cells.max()[1]; ++j) {
            for (int k = cells.min()[2]; k <= cells.max()[2]; ++k) {
              const Coord cell(i, j, k);
              if (!inside(cell)) continue;
              for (int a = 0; a < 3; ++a) {
                Coord next = cell;
                next[a] += velocity[a] > 0.0 ? 1 : -1;
                if (velocity[a] != 0.0 && !inside(next)) count[a] += 1.0;
              }
            }
          }
        }
        return count;
      },
      sum);
}

// Factor on the source's velocity at a time; 0 while it is off.
double factorAt(const sim::Source& source, double t) {
  if (t < source.from || t >= source.until) return 0.0;
  if (source.rate.empty()) return 1.0;
  const auto after = std::find_if(source.rate.begin(), source.rate.end(),
                                  [&](const sim::RatePoint& point) { return point.time > t; });
  if (after == source.rate.begin()) return after->factor;
  const sim::RatePoint& before = *(after - 1);
  if (after == source.rate.end()) return before.factor;
  return before.factor + (t - before.time) / (after->time - before.time) * (after->factor - before.factor);
}

}  // namespace

double inflow(const scenes::Scene& scene) {
  const sim::Options& options = scene.sim;
  const double h = options.voxelSize(), step = 1.0 / options.frameRate;
  double volume = 0.0;
  for (const sim::Source& source : options.sources) {
    const sim::ShapeDistance shape(source.shape, h, sim::domainBox(options));
    const openvdb::BBoxd bounds = shape.boundsIn(sim::domainBox(options));
    openvdb::CoordBBox cells = sim::cellsIn(bounds, h);
    cells.intersect(sim::domainCells(options));
    if (cells.empty()) continue;
    Vec3d velocity = source.velocity;
    if (velocity == Vec3d(0.0)) {
      // As fast as it falls over its own height.
      const int up = upAxis(options);
      const double fall = std::sqrt(2.0 * std::abs(options.gravity[up]) * bounds.extents()[up]);
      velocity[up] = options.gravity[up] > 0.0 ? fall : -fall;
    }
    const std::array<double, 3> faces = frontFaces(shape, cells, h, velocity);
    double rate = 0.0;
    for (int a = 0; a < 3; ++a) rate += faces[a] * std::abs(velocity[a]) * h * h;
    for (int n = 0; n + 1 < scene.frames; ++n) volume += rate * step * factorAt(source, (n + 0.5) * step);
  }
  return volume;
}

double foreseenSurface(const scenes::Scene& scene) {
  const sim::Options& options = scene.sim;
  const bool later = std::any_of(options.liquid.begin(), options.liquid.end(),
                                 [](const sim::LiquidBody& body) { return body.from > 0.0; });
  if (options.sources.empty() && !later) return 0.0;
  const double h = options.voxelSize(), volume = inflow(scene);
  const double poured = static_cast<double>(planLiquid(options).surfaceCells) * h * h;
  const int up = upAxis(options);
  const double length = options.size[(up + 1) % 3], width = options.size[(up + 2) % 3];
  const double depth = std::min(volume / (length * width), options.size[up]);
  const double sheet = 2.0 * volume / h, pool = 2.0 * (length * width + (length + width) * depth);
  return poured + std::min(sheet, pool);
}

double foreseenSpacing(const scenes::Scene& scene) {
  return std::sqrt(foreseenSurface(scene) / scene.texture.points);
}

}  // namespace fluidtex::pipeline
