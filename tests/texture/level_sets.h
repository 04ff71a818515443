// Level sets of known shape, for the tests of surface preparation.
#pragma once

#include "texture/level_set.h"

#include <openvdb/openvdb.h>
#include <openvdb/tools/Composite.h>
#include <openvdb/tools/LevelSetSphere.h>
#include <openvdb/tools/SignedFloodFill.h>

#include <cmath>
#include <functional>
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

}  // namespace fluidtex::texture
