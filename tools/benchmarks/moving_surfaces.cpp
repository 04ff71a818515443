#include "tools/benchmarks/moving_surfaces.h"

#include "sim/step/solver.h"
#include "texture/loops/parallel.h"
#include "texture/mesh/prepare.h"
#include "tools/benchmarks/closed_dam_break.h"
#include "tools/benchmarks/deformed_shapes.h"
#include "transport/carry.h"

#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>

namespace fluidtex::benchmarks {
namespace {

using openvdb::Vec3d;
using texture::Vec3f;

constexpr double kFrame = 1.0 / 24.0;  // s
constexpr double kPi = std::numbers::pi;

MovingSurface inDeformation(const Shape& shape, double t0, double t1, double voxel) {
  MovingSurface surface;
  surface.before = levelSetOf(deformed(shape, 0.0, t0), voxel);
  surface.now = levelSetOf(deformed(shape, 0.0, t1), voxel);
  surface.spacing = voxel;
  surface.moved = [t0, t1](const std::vector<Vec3f>& points) {
    std::vector<Vec3f> result(points.size());
    texture::forEachIndex(points.size(), [&](std::uint32_t i) {
      result[i] = Vec3f(carriedByDeformation(Vec3d(points[i]), t0, t1));
    });
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

MovingSurface movingSurface(const std::string& name, int points) {
  constexpr double kRadius = 0.15, kMajor = 0.2, kMinor = 0.08;
  if (name == "sphere")
    return inDeformation(enrightSphere(points), 0.0, kFrame,
                         std::sqrt(4.0 * kPi * kRadius * kRadius / points));
  if (name == "stretched") {
    return inDeformation(enrightSphere(4 * points), 1.5 - kFrame, 1.5, std::sqrt(kStretchedArea / points));
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
