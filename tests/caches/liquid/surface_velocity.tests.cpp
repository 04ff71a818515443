#include "caches/liquid/surface_velocity.h"

#include "caches/liquid/face_sampler.h"
#include "tests/caches/liquid/flows.h"

#include <catch2/catch.hpp>

#include <functional>

using namespace fluidtex;
using namespace fluidtex::caches;

namespace {

constexpr double kCell = 0.02;

// A ball of 10 cells with a velocity at its points.
struct Moving {
  SurfaceTriangles surface;
  std::vector<float> velocity;
};

Moving moving(const std::function<Vec3d(const Vec3d&)>& velocity) {
  std::vector<Vec3d> points;
  Moving made;
  ballMesh({}, 5, points, made.surface.triangles);
  for (const Vec3d& x : points) {
    made.surface.points.emplace_back(x);
    for (int axis = 0; axis < 3; ++axis) made.velocity.push_back(float(velocity(x)[axis]));
  }
  return made;
}

// Largest error at cells within `reach` cells of the ball's surface.
double farthest(const Moving& made, const std::function<Vec3d(const Vec3d&)>& right, double reach) {
  ClosestTriangles closest(made.surface, kCell);
  const sim::FaceGrids grids = velocityOffSurface(closest, made.velocity, 6);
  const Ball ball;
  double most = 0.0;
  std::size_t count = 0;
  for (auto value = grids[0].cbeginValueOn(); value; ++value) {
    const Vec3d x = grids[0].indexToWorld(value.getCoord());
    if (std::abs(ball.distance(x)) > reach * kCell) continue;
    Vec3d u;
    for (int axis = 0; axis < 3; ++axis) u[axis] = double(grids[axis].tree().getValue(value.getCoord()));
    most = std::max(most, (u - right(x)).length());
    ++count;
  }
  REQUIRE(count > 1000);
  return most;
}

}  // namespace

TEST_CASE("surface velocity: what turns as a solid is continued as a solid", "[caches]") {
  openvdb::initialize();
  const Vec3d about(1.0, -2.0, 3.0), along(0.5, 0.0, -1.0);
  const auto turning = [&](const Vec3d& x) { return along + about.cross(x - Vec3d(0.5)); };
  const Moving made = moving(turning);
  // At two cells' distance the velocity differs by up to 0.15 m/s from that at the surface.
  CHECK(farthest(made, turning, 2.0) < 0.01);
  CHECK(farthest(made, turning, 5.0) < 0.25);
}

TEST_CASE("surface velocity: what moves across the surface is continued as it is there", "[caches]") {
  openvdb::initialize();
  const Ball ball;
  const auto drawn = [&](const Vec3d& x) {
    const Vec3d d = x - ball.center;
    return Vec3d(d[0], d[1], -2.0 * d[2]);
  };
  const Moving made = moving(drawn);
  ClosestTriangles closest(made.surface, kCell);
  const sim::FaceGrids grids = velocityOffSurface(closest, made.velocity, 6);
  const FaceSampler sampler(grids);
  for (const double off : {-1.5, 1.5}) {
    Vec3d u;
    REQUIRE(sampler.at(ball.center + Vec3d(0.0, 0.0, ball.radius + off * kCell), u));
    CHECK(u[2] == Approx(-2.0 * ball.radius).epsilon(0.02));
    REQUIRE(sampler.at(ball.center + Vec3d(ball.radius + off * kCell, 0.0, 0.0), u));
    CHECK(u[0] == Approx(ball.radius).epsilon(0.02));
  }
}
