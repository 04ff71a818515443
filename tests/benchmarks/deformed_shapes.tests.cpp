#include "tools/benchmarks/deformed_shapes.h"

#include <catch2/catch.hpp>

#include <atomic>
#include <cmath>
#include <numbers>

using namespace fluidtex;
using namespace fluidtex::benchmarks;
using openvdb::Vec3d;

namespace {

// Metres by which points may be off that are carried in steps of a fortieth of a second.
constexpr double kClose = 1e-5;

const Vec3d kPlaces[] = {{0.3, 0.4, 0.45}, {0.7, 0.2, 0.9}, {0.5, 0.25, 0.1}, {0.05, 0.6, 0.35}};

}  // namespace

TEST_CASE("deformed shapes: the flow is LeVeque's", "[benchmarks]") {
  // At quarters all squares are 1/2, and all sines of twice the angle 1 or -1.
  CHECK(deformationVelocity({0.25, 0.25, 0.25}, 0.0).eq({1.0, -0.5, -0.5}, 1e-12));
  CHECK(deformationVelocity({0.25, 0.75, 0.25}, 0.0).eq({-1.0, -0.5, 0.5}, 1e-12));
  CHECK(deformationVelocity({0.75, 0.25, 0.25}, 0.0).eq({1.0, 0.5, 0.5}, 1e-12));
  // It slows down like a cosine, turns after half of 3 s, and goes back.
  CHECK(deformationVelocity({0.25, 0.25, 0.25}, 1.0).eq({0.5, -0.25, -0.25}, 1e-12));
  CHECK(deformationVelocity({0.25, 0.25, 0.25}, 1.5).length() < 1e-12);
  CHECK(deformationVelocity({0.25, 0.25, 0.25}, 3.0).eq({-1.0, 0.5, 0.5}, 1e-12));
}

TEST_CASE("deformed shapes: the flow keeps volume and does not leave the cube", "[benchmarks]") {
  constexpr double kStep = 1e-5;
  for (const Vec3d& p : kPlaces) {
    double divergence = 0.0;
    for (int a = 0; a < 3; ++a) {
      Vec3d low = p, high = p;
      low[a] -= kStep;
      high[a] += kStep;
      divergence += (deformationVelocity(high, 0.4)[a] - deformationVelocity(low, 0.4)[a]) / (2.0 * kStep);
      Vec3d wall = p;
      for (const double side : {0.0, 1.0}) {
        wall[a] = side;
        CHECK(std::abs(deformationVelocity(wall, 0.4)[a]) < 1e-12);
      }
    }
    CHECK(std::abs(divergence) < 1e-8);
  }
}

TEST_CASE("deformed shapes: points are carried with the flow, there and back", "[benchmarks]") {
  for (const Vec3d& p : kPlaces) {
    // The rate at which a point begins to move, and at which it moves on.
    constexpr double kMoment = 1e-4;
    CHECK(
        ((carriedByDeformation(p, 0.2, 0.2 + kMoment) - p) / kMoment).eq(deformationVelocity(p, 0.2), 1e-3));
    const Vec3d later = carriedByDeformation(p, 0.0, 1.2);
    CHECK((later - p).length() > 0.05);
    CHECK(carriedByDeformation(later, 1.2, 0.0).eq(p, kClose));
    // After the turn it goes back the same way.
    CHECK(carriedByDeformation(p, 0.0, 1.8).eq(later, kClose));
    CHECK(carriedByDeformation(p, 0.0, 3.0).eq(p, kClose));
    CHECK(carriedByDeformation(p, 0.7, 0.7) == p);
    // Many short ways are one long way.
    Vec3d piecewise = p;
    for (int n = 0; n < 240; ++n) piecewise = carriedByDeformation(piecewise, 0.005 * n, 0.005 * (n + 1));
    CHECK(piecewise.eq(later, kClose));
  }
}

TEST_CASE("deformed shapes: points at random by their parameters, always the same", "[benchmarks]") {
  std::atomic<int> outside = 0;
  const auto parameters = [&](double u, double v) {
    if (!(u >= 0.0 && u < 1.0 && v >= 0.0 && v < 1.0)) ++outside;
    return Vec3d(u, v, 0.0);
  };
  const std::vector<Vec3d> points = scattered(4000, parameters);
  REQUIRE(points.size() == 4000);
  CHECK(outside == 0);
  CHECK(scattered(4000, parameters) == points);
  int count[4][4] = {};
  for (const Vec3d& p : points) ++count[int(4.0 * p.x())][int(4.0 * p.y())];
  // 250 each, give or take four standard deviations.
  for (const auto& row : count)
    for (const int n : row) CHECK(std::abs(n - 250) < 62);
  CHECK(scattered(0, parameters).empty());
}

TEST_CASE("deformed shapes: the sphere is evenly covered, equal heights for equal shares", "[benchmarks]") {
  CHECK(onSphere(0.0, 0.3).eq({0.0, 0.0, -1.0}, 1e-12));
  CHECK(onSphere(1.0, 0.3).eq({0.0, 0.0, 1.0}, 1e-12));
  CHECK(onSphere(0.5, 0.0).eq({1.0, 0.0, 0.0}, 1e-12));
  CHECK(onSphere(0.5, 0.25).eq({0.0, 1.0, 0.0}, 1e-12));
  for (const double u : {0.1, 0.4, 0.75}) {
    CHECK(onSphere(u, 0.6).length() == Approx(1.0));
    CHECK(onSphere(u, 0.6).z() == Approx(2.0 * u - 1.0));
  }
}

TEST_CASE("deformed shapes: a level set holds distances, whatever the function's slope", "[benchmarks]") {
  const Vec3d centre(0.51, 0.48, 0.53);
  constexpr double kRadius = 0.3, kVoxel = 0.03;
  for (const double slope : {1.0, 40.0}) {
    Shape ball{[&](const Vec3d& x) { return slope * ((x - centre).length() - kRadius); }, {}};
    for (const Vec3d& p : scattered(2000, onSphere)) ball.points.push_back(centre + p * kRadius);
    const openvdb::FloatGrid::Ptr grid = levelSetOf(ball, kVoxel);
    CHECK(grid->getGridClass() == openvdb::GRID_LEVEL_SET);
    CHECK(grid->background() == Approx(3.0 * kVoxel));
    CHECK(grid->voxelSize().eq(Vec3d(kVoxel), 1e-12));
    int band = 0;
    for (auto it = grid->cbeginValueOn(); it; ++it) {
      const double distance = (grid->indexToWorld(it.getCoord()) - centre).length() - kRadius;
      REQUIRE(std::abs(double(*it)) < 3.0 * kVoxel);
      // The slope of a ball of ten cells is at most 6% off, by the steeper of two differences.
      REQUIRE(double(*it) == Approx(distance).epsilon(0.08).margin(1e-6));
      ++band;
    }
    const double inner = kRadius - 3.0 * kVoxel, outer = kRadius + 3.0 * kVoxel;
    CHECK(band == Approx(4.0 / 3.0 * std::numbers::pi * (std::pow(outer, 3) - std::pow(inner, 3)) /
                         std::pow(kVoxel, 3))
                      .epsilon(0.1));
    const auto at = [&](const Vec3d& x) {
      return grid->tree().getValue(openvdb::Coord::round(grid->worldToIndex(x)));
    };
    CHECK(at(centre) == Approx(-3.0 * kVoxel));
    CHECK(at(Vec3d(0.9)) == Approx(3.0 * kVoxel));
  }
}

TEST_CASE("deformed shapes: a shape's points and its function are carried alike", "[benchmarks]") {
  const Shape sphere = enrightSphere(50);
  REQUIRE(sphere.points.size() == 50);
  CHECK(sphere.value(Vec3d(0.35)) == Approx(-0.15));
  for (const Vec3d& p : sphere.points) CHECK((p - Vec3d(0.35)).length() == Approx(0.15));
  const Shape later = deformed(sphere, 0.0, 1.1), back = deformed(later, 1.1, 0.0);
  REQUIRE(later.points.size() == 50);
  double moved = 0.0;
  for (std::size_t n = 0; n < 50; ++n) {
    CHECK(later.points[n].eq(carriedByDeformation(sphere.points[n], 0.0, 1.1), 1e-12));
    CHECK(std::abs(later.value(later.points[n])) < kClose);
    CHECK(back.points[n].eq(sphere.points[n], kClose));
    moved += (later.points[n] - sphere.points[n]).length() / 50.0;
  }
  CHECK(moved > 0.05);
  CHECK(later.value(carriedByDeformation(Vec3d(0.35), 0.0, 1.1)) == Approx(-0.15));
}

TEST_CASE("deformed shapes: the most stretched sphere has the area that is told", "[benchmarks]") {
  // By how much the flow has stretched each piece of the sphere. A mesh that is carried folds up: where the
  // sheet is drawn out a hundredfold its triangles are no longer the surface.
  constexpr int kPieces = 60;
  constexpr double kStep = 1e-5;
  double stretch = 0.0;
  for (int i = 0; i < kPieces; ++i) {
    for (int j = 0; j < kPieces; ++j) {
      const Vec3d n = onSphere((i + 0.5) / kPieces, (j + 0.5) / kPieces);
      const Vec3d along = Vec3d(-n.y(), n.x(), 0.0).unit(), up = n.cross(along);
      const auto carried = [&](const Vec3d& aside) {
        return carriedByDeformation(Vec3d(0.35) + 0.15 * n + kStep * aside, 0.0, 1.5);
      };
      const Vec3d a = carried(along) - carried(-along), b = carried(up) - carried(-up);
      stretch += a.cross(b).length() / (4.0 * kStep * kStep);
    }
  }
  CHECK(4.0 * std::numbers::pi * 0.15 * 0.15 * stretch / (kPieces * kPieces) ==
        Approx(kStretchedArea).epsilon(0.01));
}
