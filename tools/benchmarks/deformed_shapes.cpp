#include "tools/benchmarks/deformed_shapes.h"

#include "numerics/random.h"
#include "texture/loops/parallel.h"

#include <openvdb/tools/Morphology.h>
#include <openvdb/tools/SignedFloodFill.h>
#include <openvdb/tree/LeafManager.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fluidtex::benchmarks {
namespace {

using openvdb::FloatGrid;
using openvdb::Vec3d;

constexpr double kPi = std::numbers::pi;

}  // namespace

Vec3d deformationVelocity(const Vec3d& p, double t) {
  const double pace = std::cos(kPi * t / 3.0);
  Vec3d square, twice;  // sin(pi x)^2 and sin(2 pi x) along each axis
  for (int axis = 0; axis < 3; ++axis) {
    const double s = std::sin(kPi * p[axis]), c = std::cos(kPi * p[axis]);
    square[axis] = s * s;
    twice[axis] = 2.0 * s * c;
  }
  return pace * Vec3d(2.0 * square[0] * twice[1] * twice[2], -twice[0] * square[1] * twice[2],
                      -twice[0] * twice[1] * square[2]);
}

Vec3d carriedByDeformation(Vec3d p, double from, double to) {
  constexpr double kStep = 0.025;  // s
  const int steps = std::max(1, int(std::ceil(std::abs(to - from) / kStep)));
  const double dt = (to - from) / steps;
  for (int s = 0; s < steps; ++s) {
    const double t = from + s * dt;
    const Vec3d k1 = deformationVelocity(p, t), k2 = deformationVelocity(p + 0.5 * dt * k1, t + 0.5 * dt),
                k3 = deformationVelocity(p + 0.5 * dt * k2, t + 0.5 * dt),
                k4 = deformationVelocity(p + dt * k3, t + dt);
    p += dt / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  }
  return p;
}

FloatGrid::Ptr levelSetOf(const Shape& shape, double voxel) {
  openvdb::initialize();
  constexpr float kBand = 3.0f;
  auto raw = FloatGrid::create(0.0f);
  raw->setTransform(openvdb::math::Transform::createLinearTransform(voxel));
  auto acc = raw->getAccessor();
  for (const Vec3d& p : shape.points) acc.setValueOn(openvdb::Coord::round(p / voxel), 0.0f);
  openvdb::tools::dilateActiveValues(raw->tree(), int(kBand) + 4, openvdb::tools::NN_FACE_EDGE_VERTEX,
                                     openvdb::tools::IGNORE_TILES);
  openvdb::tree::LeafManager<openvdb::FloatTree> leaves(raw->tree());
  leaves.foreach ([&](auto& leaf, std::size_t) {
    for (auto it = leaf.beginValueOn(); it; ++it)
      it.setValue(float(shape.value(it.getCoord().asVec3d() * voxel) / voxel));
  });
  // In `scaled` the distances; only those within the band go into the level set, so that the rest is told by
  // its sign.
  FloatGrid::Ptr scaled = raw->deepCopy();
  openvdb::tree::LeafManager<openvdb::FloatTree> made(scaled->tree());
  made.foreach ([&](auto& leaf, std::size_t) {
    const auto values = raw->getConstAccessor();
    for (auto it = leaf.beginValueOn(); it; ++it) {
      const openvdb::Coord ijk = it.getCoord();
      Vec3d slope(0.0);
      for (int axis = 0; axis < 3; ++axis) {
        // The steeper side: in the middle of a thin sheet or between two drops their mean says nothing.
        for (const int side : {-1, 1}) {
          openvdb::Coord next = ijk;
          next[axis] += side;
          if (!values.isValueOn(next)) continue;
          const double step = double(values.getValue(next)) - double(values.getValue(ijk));
          slope[axis] = std::max(slope[axis], std::abs(step));
        }
      }
      it.setValue(values.getValue(ijk) / float(std::max(slope.length(), 1e-3)));
    }
  });
  auto grid = FloatGrid::create(kBand * float(voxel));
  grid->setTransform(raw->transform().copy());
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  auto out = grid->getAccessor();
  for (auto it = scaled->cbeginValueOn(); it; ++it) {
    if (std::abs(*it) < kBand) out.setValue(it.getCoord(), float(voxel) * *it);
  }
  openvdb::tools::signedFloodFill(grid->tree());
  return grid;
}

std::vector<Vec3d> scattered(int count, const std::function<Vec3d(double, double)>& at) {
  std::vector<Vec3d> points(static_cast<std::size_t>(count));
  texture::forEachIndex(points.size(), [&](std::uint32_t i) {
    points[i] = at(randomUnit(1, 2ull * i), randomUnit(1, 2ull * i + 1));
  });
  return points;
}

Vec3d onSphere(double u, double v) {
  const double z = 2.0 * u - 1.0, r = std::sqrt(1.0 - z * z), a = 2.0 * kPi * v;
  return {r * std::cos(a), r * std::sin(a), z};
}

Shape deformed(const Shape& shape, double start, double t) {
  Shape result{[=](const Vec3d& x) { return shape.value(carriedByDeformation(x, t, start)); }, shape.points};
  texture::forEachIndex(result.points.size(), [&](std::uint32_t i) {
    result.points[i] = carriedByDeformation(shape.points[i], start, t);
  });
  return result;
}

Shape enrightSphere(int samples) {
  const Vec3d centre(0.35);
  constexpr double kRadius = 0.15;
  Shape shape{[=](const Vec3d& x) { return (x - centre).length() - kRadius; }, {}};
  for (const Vec3d& p : scattered(samples, onSphere)) shape.points.push_back(centre + p * kRadius);
  return shape;
}

}  // namespace fluidtex::benchmarks
