#include "tools/validation/aligned_cases.h"

#include "sim/step/solver.h"
#include "tools/validation/face_velocities.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace fluidtex::validation {
namespace {

using sim::Box;
using sim::Cylinder;
using sim::Difference;
using sim::Shape;
using sim::Sphere;
using sim::Vec3d;

constexpr int kRoom = 12;  // cells along each side of the domain; a cell is a metre
constexpr double kEnd = kRoom, kBeyond = kRoom + 1.0;
constexpr int kFramesOfPool = 3;
constexpr double kStill = 0.01;  // of sqrt(g h): what is slower rests
constexpr double kLevels[] = {5.0, 5.25, 5.5, 6.0};

struct Pool {
  std::vector<Shape> liquid, solids;
};

Shape box(const Vec3d& low, const Vec3d& high) {
  return {Box{low, high}};
}
Shape upright(double middle, double low, double high, double radius) {
  return {Cylinder{Vec3d(middle, middle, low), Vec3d(middle, middle, high), radius}};
}
Shape cutOut(Shape whole, Shape part) {
  return {Difference{{std::move(whole), std::move(part)}}};
}
Shape filledTo(double level) {
  return box(Vec3d(0.0), Vec3d(kEnd, kEnd, level));
}

// On one side or both sides of a wall across the domain.
void addWalls(double level, std::vector<Pool>& pools) {
  for (const int axis : {0, 1}) {
    for (const double low : {4.0, 4.25, 4.5}) {
      for (const double thickness : {0.5, 1.0, 1.5, 2.0, 4.0}) {
        Vec3d start(0.0), end(kEnd, kEnd, level), wallLow(-1.0), wallHigh(kBeyond);
        end[axis] = wallLow[axis] = low;
        start[axis] = wallHigh[axis] = low + thickness;
        const Shape wall = box(wallLow, wallHigh), one = box(Vec3d(0.0), end);
        pools.push_back({{one}, {wall}});
        pools.push_back({{one, box(start, Vec3d(kEnd, kEnd, level))}, {wall}});
      }
    }
  }
}

// In basins that are cut out of a block, and in those of five boxes.
void addBasins(double level, std::vector<Pool>& pools) {
  for (const double low : {2.0, 2.25, 2.5}) {
    for (const double wall : {0.5, 1.0, 1.5, 2.0}) {
      const double high = kEnd - low, outer = low - wall, beyond = high + wall, rim = 10.0;
      const Shape liquid = box(Vec3d(low), Vec3d(high, high, level));
      pools.push_back({{liquid},
                       {cutOut(box(Vec3d(outer), Vec3d(beyond, beyond, rim)),
                               box(Vec3d(low), Vec3d(high, high, rim + 1.0)))}});
      pools.push_back({{liquid},
                       {box(Vec3d(outer), Vec3d(beyond, beyond, low)),
                        box(Vec3d(outer, outer, low), Vec3d(low, beyond, rim)),
                        box(Vec3d(high, outer, low), Vec3d(beyond, beyond, rim)),
                        box(Vec3d(low, outer, low), Vec3d(high, low, rim)),
                        box(Vec3d(low, high, low), Vec3d(high, beyond, rim))}});
    }
  }
}

// Around blocks, balls and columns that the surface cuts, covers or touches, and in round cups.
void addBodies(double level, std::vector<Pool>& pools) {
  for (const double top : {2.5, 4.0, 4.5, 5.5, 7.0})
    for (const double low : {3.0, 3.25, 3.5})
      pools.push_back({{filledTo(level)}, {box(Vec3d(low, low, -1.0), Vec3d(kEnd - low, kEnd - low, top))}});
  for (const double middle : {6.0, 6.5}) {
    for (const double radius : {2.0, 2.5}) {
      for (const double height : {5.0, 5.5, 6.0}) {
        pools.push_back({{filledTo(level)}, {{Sphere{Vec3d(middle, middle, height), radius}}}});
        pools.push_back({{filledTo(level)}, {upright(middle, -1.0, height, radius)}});
      }
      pools.push_back(
          {{upright(middle, 1.0, level, radius)},
           {cutOut(upright(middle, 0.0, 11.0, radius + 1.0), upright(middle, 1.0, 12.0, radius))}});
    }
  }
}

// Two bodies of liquid that share a face.
void addJoints(double level, std::vector<Pool>& pools) {
  for (const int axis : {0, 2}) {
    for (const double joint : {4.0, 4.25, 4.5}) {
      Vec3d start(0.0), end(kEnd, kEnd, level);
      start[axis] = end[axis] = joint;
      pools.push_back({{box(Vec3d(0.0), end), box(start, Vec3d(kEnd, kEnd, level))}, {}});
    }
  }
}

// On a floor, poured onto it or into it, and below lids over the whole surface or a half of it.
void addFloorsAndLids(std::vector<Pool>& pools) {
  for (const double top : {2.0, 2.5, 3.25, 5.0, 5.5})
    for (const double from : {0.0, top})
      pools.push_back({{box(Vec3d(0.0, 0.0, from), Vec3d(kEnd, kEnd, top + 3.0))},
                       {box(Vec3d(-1.0), Vec3d(kBeyond, kBeyond, top))}});
  for (const double lid : {4.5, 5.0, 5.25}) {
    pools.push_back({{filledTo(lid)}, {box(Vec3d(-1.0, -1.0, lid), Vec3d(kBeyond))}});
    for (const double end : {6.0, 6.5})
      pools.push_back({{filledTo(lid)}, {box(Vec3d(-1.0, -1.0, lid), Vec3d(kBeyond, end, lid + 2.0))}});
  }
}

std::vector<Pool> alignedPools() {
  std::vector<Pool> pools;
  for (const double level : kLevels) {
    addWalls(level, pools);
    addBasins(level, pools);
    addBodies(level, pools);
    addJoints(level, pools);
  }
  addFloorsAndLids(pools);
  return pools;
}

// The fastest in some frames, in sqrt(g h).
double fastestIn(const Pool& pool, double viscosity, sim::WallKind wall) {
  sim::Options options;
  options.resolution = kRoom;
  options.size = Vec3d(kEnd);
  options.frameRate = 5.0;
  options.viscosity = viscosity;
  for (const Shape& shape : pool.liquid) options.liquid.push_back({.shape = shape});
  for (const Shape& shape : pool.solids) {
    sim::Solid& solid = options.solids.emplace_back();
    solid.shape = shape;
    solid.wall.kind = wall;
  }
  sim::Solver solver(options);
  double fastest = 0.0;
  for (int n = 0; n < kFramesOfPool; ++n) {
    solver.next();
    fastest = std::max(fastest, fastestOf(solver.state()));
  }
  return fastest / std::sqrt(kGravity);
}

Result rest(const std::string& test, double viscosity, sim::WallKind wall, const Progress& progress) {
  const std::vector<Pool> pools = alignedPools();
  int moving = 0;
  double fastest = 0.0;
  for (std::size_t n = 0; n < pools.size(); ++n) {
    const double speed = fastestIn(pools[n], viscosity, wall);
    moving += speed > kStill ? 1 : 0;
    fastest = std::max(fastest, speed);
    if (progress) progress((n + 1.0) / static_cast<double>(pools.size()));
  }
  Result result;
  result.rows = {row(test, kRoom, "pools that move, of " + std::to_string(pools.size()), moving, 0.0, {}),
                 row(test, kRoom, "max |u| / sqrt(g h)", fastest, kStill, {})};
  return result;
}

}  // namespace

std::vector<Case> alignedCases() {
  const auto water = [](int, const Progress& progress) {
    return rest("rest_aligned", 0.0, sim::WallKind::slip, progress);
  };
  const auto honey = [](int, const Progress& progress) {
    return rest("rest_aligned_viscous", 1000.0, sim::WallKind::noSlip, progress);
  };
  return {
      {"rest_aligned",
       "fluid",
       "Pools at rest beside solids on halves and quarters of cells",
       {kRoom},
       {},
       water,
       {}},
      {"rest_aligned_viscous", "fluid", "The same, very viscous and without slip", {kRoom}, {}, honey, {}}};
}

}  // namespace fluidtex::validation
