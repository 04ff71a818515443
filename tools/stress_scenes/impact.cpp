#include "tools/stress_scenes/impact.h"

#include "sim/grid/normal.h"
#include "sim/shapes/shape_distance.h"
#include "sim/solids/domain.h"
#include "sim/solids/solids.h"
#include "tools/stress_scenes/surroundings.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

namespace fluidtex::stress {
namespace {

using Distance = std::function<double(const Vec3d&)>;

// Distances to each closed side of the domain and to each solid that is there.
std::vector<Distance> wallsAt(const sim::Options& options, double time) {
  std::vector<Distance> walls;
  for (int side = 0; side < 6; ++side) {
    if (!sim::isClosed(options.sides[side])) continue;
    const int a = side / 2;
    walls.emplace_back(
        [a, up = side % 2 == 1, end = options.size[a]](const Vec3d& x) { return up ? end - x[a] : x[a]; });
  }
  for (const sim::Solid& solid : options.solids) {
    if (time < solid.from || time >= solid.until) continue;
    sim::Options alone = options;
    alone.sides.fill(sim::Side::unbounded);
    alone.solids = {solid};
    walls.emplace_back([solids = std::make_shared<sim::Solids>(alone), time](const Vec3d& x) {
      return solids->distance(x, time);
    });
  }
  return walls;
}

// Of the cells of a body: how far they reach, and the greatest speed that walls beside one of them stop.
struct Stopped {
  openvdb::CoordBBox cells;
  double speed = 0.0;
};

Stopped stoppedBy(const std::vector<Distance>& walls, const sim::LiquidBody& body,
                  const sim::Options& options) {
  const double h = options.voxelSize();
  const sim::ShapeDistance shape(body.shape, h, sim::domainBox(options));
  const openvdb::CoordBBox cells = sampledCells(options);
  Stopped found;
  for (auto cell = cells.begin(); cell; ++cell) {
    const Vec3d x = ((*cell).asVec3d() + Vec3d(0.5)) * h;
    if (shape(x) >= 0.0) continue;
    double speed = 0.0, nearest = INFINITY;
    for (const Distance& wall : walls) {
      const double away = wall(x);
      nearest = std::min(nearest, away);
      if (away > 0.0 && away <= h)
        speed += std::max(0.0, -body.velocity.dot(sim::normalAt(wall, x, 0.01 * h)));
    }
    if (nearest <= 0.0) continue;
    found.cells.expand(*cell);
    found.speed = std::max(found.speed, speed);
  }
  return found;
}

}  // namespace

double impactSpeed(const sim::Options& options) {
  double fastest = 0.0;
  for (const sim::LiquidBody& body : options.liquid) {
    if (body.velocity == Vec3d(0.0)) continue;
    const auto [cells, speed] = stoppedBy(wallsAt(options, body.from), body, options);
    if (cells.empty()) continue;
    const double depth = std::min({cells.dim()[0], cells.dim()[1], cells.dim()[2]});  // in cells
    fastest = std::max(fastest, -2.0 / M_PI * speed * std::log(std::tanh(M_PI / (8.0 * depth))));
  }
  return fastest;
}

}  // namespace fluidtex::stress
