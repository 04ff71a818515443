#include "tools/benchmarks/moving_surfaces.h"

#include "sim/solver.h"
#include "texture/parallel.h"
#include "texture/prepare.h"
#include "texture/random.h"
#include "tools/benchmarks/closed_dam_break.h"
#include "transport/carry.h"

#include <openvdb/tools/Morphology.h>
#include <openvdb/tools/SignedFloodFill.h>
#include <openvdb/tree/LeafManager.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>

namespace fluidtex::benchmarks {
namespace {

using openvdb::FloatGrid;
using openvdb::Vec3d;
using texture::Vec3f;

constexpr double kFrame = 1.0 / 24.0;  // s
constexpr double kPi = std::numbers::pi;

// Where p at time `from` is at time `to`, by fourth-order Runge-Kutta.
Vec3d carried(Vec3d p, double from, double to) {
  constexpr double kStep = 0.025;  // s
  const int steps = std::max(1, int(std::ceil(std::abs(to - from) / kStep)));
  const double dt = (to - from) / steps;
  for (int s = 0; s < steps; ++s) {
    const double t = from + s * dt;
    const Vec3d k1 = deformationVelocity(p, t), k2 = deformationVelocity(p + 0.5 * dt * k1, t + 0.5 * dt),
                k3 = deformationVelocity(p + 0.5 * dt * k2, t + 0.5 * dt), k4 = deformationVelocity(p + dt * k3, t + dt);
    p += dt / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  }
  return p;
}

// A shape given by any function with its zero set and sign; points near the zero set.
struct Shape {
  std::function<double(const Vec3d&)> value;
  std::vector<Vec3d> points;
};

// Its level set: the function over the length of its gradient, within three voxels of the given points, which
// may be four voxels apart.
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

// About `count` points of a closed parameterised surface, at random by its parameters.
std::vector<Vec3d> scattered(int count, const std::function<Vec3d(double, double)>& at) {
  std::vector<Vec3d> points(static_cast<std::size_t>(count));
  texture::forEachIndex(points.size(), [&](std::uint32_t i) {
    points[i] = at(texture::randomUnit(1, 2ull * i), texture::randomUnit(1, 2ull * i + 1));
  });
  return points;
}

Vec3d onSphere(double u, double v) {
  const double z = 2.0 * u - 1.0, r = std::sqrt(1.0 - z * z), a = 2.0 * kPi * v;
  return {r * std::cos(a), r * std::sin(a), z};
}

// A shape at time `start` of the deformation, as it is at time `t`.
Shape deformed(const Shape& shape, double start, double t) {
  Shape result{[=](const Vec3d& x) { return shape.value(carried(x, t, start)); }, shape.points};
  texture::forEachIndex(result.points.size(),
                        [&](std::uint32_t i) { result.points[i] = carried(shape.points[i], start, t); });
  return result;
}

MovingSurface inDeformation(const Shape& shape, double t0, double t1, double voxel) {
  MovingSurface surface;
  surface.before = levelSetOf(deformed(shape, 0.0, t0), voxel);
  surface.now = levelSetOf(deformed(shape, 0.0, t1), voxel);
  surface.spacing = voxel;
  surface.moved = [t0, t1](const std::vector<Vec3f>& points) {
    std::vector<Vec3f> result(points.size());
    texture::forEachIndex(points.size(),
                          [&](std::uint32_t i) { result[i] = Vec3f(carried(Vec3d(points[i]), t0, t1)); });
    return result;
  };
  return surface;
}

MovingSurface drops(double gap, int points) {
  constexpr double kRadius = 0.15, kSpeed = 0.5;  // m, m/s each
  const double voxel = std::sqrt(8.0 * kPi * kRadius * kRadius / points);
  const auto at = [&](double halfGap) {
    const Vec3d c(kRadius + halfGap, 0.0, 0.0);
    Shape shape{[=](const Vec3d& x) { return std::min((x - c).length(), (x + c).length()) - kRadius; }, {}};
    for (const Vec3d& p : scattered(points / 2, onSphere)) {
      shape.points.push_back(c + p * kRadius);
      shape.points.push_back(p * kRadius - c);
    }
    return levelSetOf(shape, voxel);
  };
  MovingSurface surface;
  surface.before = at(0.5 * gap * voxel + kSpeed * kFrame);
  surface.now = at(0.5 * gap * voxel);
  surface.spacing = voxel;
  surface.moved = [](const std::vector<Vec3f>& old) {
    std::vector<Vec3f> result = old;
    for (Vec3f& p : result) p.x() += float(p.x() > 0.0f ? -kSpeed * kFrame : kSpeed * kFrame);
    return result;
  };
  return surface;
}

MovingSurface river(int points) {
  constexpr double kDepth = 0.2, kSpeed = 1.0;                    // m, m/s
  const double voxel = std::sqrt((2.0 + 4.0 * kDepth) / points);  // a unit square, its bed and its sides
  const auto height = [](double x, double y) {
    return kDepth + 0.03 * std::sin(9.0 * x) * std::cos(7.0 * y);
  };
  const auto at = [&](double t) {
    const auto distance = [=](const Vec3d& p) {
      const double top = p.z() - height(p.x() - kSpeed * t, p.y());
      return std::max({top, -p.z(), p.x() - 1.0, -p.x(), p.y() - 1.0, -p.y()});
    };
    Shape shape{distance, {}};
    const int side = int(1.0 / (3.0 * voxel)) + 1;
    for (int i = 0; i <= side; ++i) {
      for (int j = 0; j <= side; ++j) {
        const double a = double(i) / side, b = double(j) / side;
        shape.points.emplace_back(a, b, height(a - kSpeed * t, b));
        shape.points.emplace_back(a, b, 0.0);
        const double level = 0.3 * b;  // higher than the water in places, where nothing is then
        for (const double end : {0.0, 1.0}) {
          shape.points.emplace_back(end, a, std::min(level, height(end - kSpeed * t, a)));
          shape.points.emplace_back(a, end, std::min(level, height(a - kSpeed * t, end)));
        }
      }
    }
    return levelSetOf(shape, voxel);
  };
  MovingSurface surface;
  surface.before = at(0.0);
  surface.now = at(kFrame);
  surface.spacing = voxel;
  surface.moved = [](const std::vector<Vec3f>& old) {
    std::vector<Vec3f> result = old;
    for (Vec3f& p : result) p.x() += float(kSpeed * kFrame);
    return result;
  };
  return surface;
}

MovingSurface damBreak(int points) {
  constexpr int kLast = 30;
  // Its surface is about three square metres by then.
  const int resolution = std::max(16, int(std::sqrt(points / 3.0)));
  sim::Solver solver(closedDamBreak(resolution));
  sim::Frame frame;
  MovingSurface surface;
  for (int f = 1; f <= kLast; ++f) {
    surface.before = frame.surfacePhi;
    frame = solver.next();
  }
  surface.now = frame.surfacePhi;
  surface.spacing = surface.now->voxelSize().x();
  const auto last = std::make_shared<const sim::Frame>(std::move(frame));
  surface.moved = [last](const std::vector<Vec3f>& old) { return transport::moved(old, *last); };
  return surface;
}

}  // namespace

Vec3d deformationVelocity(const Vec3d& p, double t) {
  const auto square = [](double x) { return x * x; };
  const double x = p.x(), y = p.y(), z = p.z(), pace = std::cos(kPi * t / 3.0);
  const double x2 = std::sin(2.0 * kPi * x), y2 = std::sin(2.0 * kPi * y), z2 = std::sin(2.0 * kPi * z);
  return pace * Vec3d(2.0 * square(std::sin(kPi * x)) * y2 * z2, -x2 * square(std::sin(kPi * y)) * z2,
                      -x2 * y2 * square(std::sin(kPi * z)));
}

MovingSurface movingSurface(const std::string& name, int points) {
  const Vec3d centre(0.35);
  constexpr double kRadius = 0.15, kMajor = 0.2, kMinor = 0.08;
  const auto sphere = [&](int samples) {
    Shape shape{[=](const Vec3d& x) { return (x - centre).length() - kRadius; }, {}};
    for (const Vec3d& p : scattered(samples, onSphere)) shape.points.push_back(centre + p * kRadius);
    return shape;
  };
  if (name == "sphere")
    return inDeformation(sphere(points), 0.0, kFrame, std::sqrt(4.0 * kPi * kRadius * kRadius / points));
  if (name == "stretched") {
    constexpr double kStretchedArea = 1.17;  // m2 at t = 1.5
    return inDeformation(sphere(4 * points), 1.5 - kFrame, 1.5, std::sqrt(kStretchedArea / points));
  }
  if (name == "torus") {
    const Vec3d middle(0.5, 0.5, 0.4);
    Shape shape{[=](const Vec3d& x) {
                  const Vec3d p = x - middle;
                  return std::hypot(std::hypot(p.x(), p.y()) - kMajor, p.z()) - kMinor;
                },
                {}};
    for (const Vec3d& p : scattered(points, [](double u, double v) { return Vec3d(u, v, 0.0); })) {
      const double a = 2.0 * kPi * p.x(), b = 2.0 * kPi * p.y(), r = kMajor + kMinor * std::cos(b);
      shape.points.push_back(middle + Vec3d(r * std::cos(a), r * std::sin(a), kMinor * std::sin(b)));
    }
    return inDeformation(shape, 0.0, kFrame, std::sqrt(4.0 * kPi * kPi * kMajor * kMinor / points));
  }
  if (name == "drops_apart") return drops(0.5, points);
  if (name == "drops_merged") return drops(-0.5, points);
  if (name == "river") return river(points);
  if (name == "dam_break") return damBreak(points);
  throw std::invalid_argument("no moving surface is called " + name);
}

}  // namespace fluidtex::benchmarks
