// Level sets of known shape, for the tests of surface preparation.
#pragma once

#include "texture/levelset/level_set.h"

#include <openvdb/openvdb.h>
#include <openvdb/tools/Composite.h>
#include <openvdb/tools/LevelSetSphere.h>
#include <openvdb/tools/SignedFloodFill.h>

#include <cmath>
#include <functional>
#include <map>
#include <string>

namespace fluidtex::texture {

using openvdb::FloatGrid;
using openvdb::Vec3d;

// A narrow band of three voxels around the zero set of a signed distance, from values inside [-half, half].
inline FloatGrid::Ptr levelSetOf(double voxel, const Vec3d& half,
                                 const std::function<double(const Vec3d&)>& distance) {
  openvdb::initialize();
  auto grid = FloatGrid::create(float(3.0 * voxel));
  grid->setTransform(openvdb::math::Transform::createLinearTransform(voxel));
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  auto acc = grid->getAccessor();
  const openvdb::CoordBBox box(openvdb::Coord::floor(-half / voxel), openvdb::Coord::ceil(half / voxel));
  for (auto it = box.begin(); it; ++it) {
    const double d = distance((*it).asVec3d() * voxel);
    if (std::abs(d) < 3.0 * voxel) acc.setValue(*it, float(d));
    if (d <= -3.0 * voxel) acc.setValueOff(*it, float(-3.0 * voxel));
  }
  openvdb::tools::signedFloodFill(grid->tree());
  return grid;
}

inline FloatGrid::Ptr sphereGrid(double radius, double voxel,
                                 const Vec3d& center = Vec3d(0.013, 0.007, 0.002)) {
  openvdb::initialize();
  return openvdb::tools::createLevelSetSphere<FloatGrid>(float(radius), openvdb::Vec3f(center), float(voxel));
}

inline FloatGrid::Ptr torusGrid(double major, double minor, double voxel) {
  const double r = major + minor + 4.0 * voxel;
  return levelSetOf(voxel, Vec3d(r, r, minor + 4.0 * voxel), [=](const Vec3d& p) {
    return std::hypot(std::hypot(p.x(), p.y()) - major, p.z()) - minor;
  });
}

inline FloatGrid::Ptr boxGrid(const Vec3d& half, double voxel) {
  return levelSetOf(voxel, half + Vec3d(4.0 * voxel), [=](const Vec3d& p) {
    return std::max({std::abs(p.x()) - half.x(), std::abs(p.y()) - half.y(), std::abs(p.z()) - half.z()});
  });
}

// Two unit spheres with a gap between them; they overlap where it is negative.
inline FloatGrid::Ptr twoSpheresGrid(double gap, double voxel) {
  const Vec3d c(1.0 + gap / 2.0, 0.0, 0.0);
  return levelSetOf(voxel, Vec3d(2.6, 1.5, 1.5),
                    [=](const Vec3d& p) { return std::min((p - c).length(), (p + c).length()) - 1.0; });
}

// A splash: the union of many spheres, some of one voxel. A counter-based hash places them.
inline FloatGrid::Ptr splashGrid(int spheres, double voxel, std::uint64_t seed) {
  const auto random = [&](std::uint64_t i) {
    std::uint64_t x = (i + 1) * 0x9e3779b97f4a7c15ULL + seed * 0xbf58476d1ce4e5b9ULL;
    x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9ULL;
    x = (x ^ x >> 27) * 0x94d049bb133111ebULL;
    return double((x ^ x >> 31) >> 11) * 0x1p-53;
  };
  FloatGrid::Ptr grid;
  for (int i = 0; i < spheres; ++i) {
    const std::uint64_t k = 4 * std::uint64_t(i);
    const double radius = voxel * (1.0 + 9.0 * std::pow(random(k), 3.0));
    const Vec3d center(random(k + 1), random(k + 2), random(k + 3));
    const FloatGrid::Ptr sphere = sphereGrid(radius, voxel, center * 50.0 * voxel);
    if (grid) {
      openvdb::tools::csgUnion(*grid, *sphere);
    } else {
      grid = sphere;
    }
  }
  return grid;
}

// Negative at one grid node alone.
inline FloatGrid::Ptr oneVoxelGrid(double voxel) {
  return levelSetOf(voxel, Vec3d(4.0 * voxel), [=](const Vec3d& p) { return p.length() - 0.5 * voxel; });
}

// Surfaces sharper or thinner than the grid holds, and smooth ones beside them; none larger than some 20
// voxels.
inline std::map<std::string, FloatGrid::Ptr> sharpGrids(double voxel) {
  std::map<std::string, FloatGrid::Ptr> grids;
  const Vec3d half(11.0 * voxel, 11.0 * voxel, 7.0 * voxel);
  // Turned against the grid, so that it is met in every way.
  const auto turned = [=](const Vec3d& p) {
    const Vec3d x = Vec3d(0.82, 0.41, 0.4).unit(), z = x.cross(Vec3d(0.2, 1.0, 0.0)).unit(), y = z.cross(x);
    return Vec3d(p.dot(x), p.dot(y), p.dot(z)) / voxel;
  };
  const auto add = [&](const std::string& name, const std::function<double(const Vec3d&)>& distance) {
    grids[name] = levelSetOf(voxel, half, [&](const Vec3d& p) { return voxel * distance(p / voxel); });
    grids[name + ", turned"] =
        levelSetOf(voxel, half, [&](const Vec3d& p) { return voxel * distance(turned(p)); });
  };
  const auto slab = [](const Vec3d& p, const Vec3d& h) {
    const Vec3d d(std::abs(p.x()) - h.x(), std::abs(p.y()) - h.y(), std::abs(p.z()) - h.z());
    return std::max({d.x(), d.y(), d.z()});
  };
  for (const double thick : {0.8, 1.1, 1.9})
    add("sheet " + std::to_string(thick),
        [=](const Vec3d& p) { return slab(p - Vec3d(0.3, 0.1, 0.2), Vec3d(6.2, 5.3, 0.5 * thick)); });
  add("sheet with a hole", [=](const Vec3d& p) {
    return std::max(slab(p, Vec3d(6.2, 5.3, 0.7)), 1.6 - std::hypot(p.x() - 0.4, p.y()));
  });
  add("wedge", [=](const Vec3d& p) {
    return std::max({slab(p, Vec3d(7.1, 4.2, 4.0)), p.z() - 0.25 * p.x() - 0.4, -p.z() - 0.7});
  });
  add("lens", [=](const Vec3d& p) {
    return std::max((p - Vec3d(0.1, 0.0, 7.0)).length(), (p + Vec3d(0.0, 0.2, 7.0)).length()) - 8.1;
  });
  add("thread",
      [=](const Vec3d& p) { return (p - Vec3d(std::clamp(p.x(), -7.0, 7.0), 0.2, 0.1)).length() - 0.8; });
  add("drops that touch", [=](const Vec3d& p) {
    return std::min((p - Vec3d(3.9, 0.1, 0.0)).length(), (p + Vec3d(3.9, 0.0, 0.2)).length()) - 3.9;
  });
  add("gap that closes", [=](const Vec3d& p) {
    return std::max(slab(p, Vec3d(6.3, 5.1, 4.2)),
                    0.12 * std::abs(p.x() + 1.0) + 0.2 - std::abs(p.z() - 0.3 * std::sin(p.y())));
  });
  for (const double radius : {0.55, 0.9, 1.4, 2.2})
    add("drop " + std::to_string(radius),
        [=](const Vec3d& p) { return (p - Vec3d(0.3, 0.2, 0.1)).length() - radius; });
  add("box", [=](const Vec3d& p) { return slab(p, Vec3d(6.02, 4.6, 3.3)); });
  add("one voxel", [](const Vec3d& p) { return p.length() - 0.5; });
  grids["splash"] = splashGrid(12, voxel, 3);
  return grids;
}

}  // namespace fluidtex::texture
