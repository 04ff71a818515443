#include "caches/liquid/particles.h"

#include "tests/caches/liquid/flows.h"

#include <catch2/catch.hpp>

#include <random>

using namespace fluidtex::caches;
using openvdb::Vec3f;

namespace {

std::vector<Vec3f> floats(const std::vector<Vec3d>& points) {
  return {points.begin(), points.end()};
}

// Each off its place by up to half of `share` spacings along each axis.
std::vector<Vec3d> jittered(std::vector<Vec3d> points, double spacing, double share) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> off(-0.5 * share * spacing, 0.5 * share * spacing);
  for (Vec3d& x : points) x += Vec3d(off(random), off(random), off(random));
  return points;
}

// A slab of 40 x 24 x `layers` particles.
std::vector<Vec3d> slab(double spacing, int layers) {
  std::vector<Vec3d> points;
  for (int i = 0; i < 40; ++i)
    for (int j = 0; j < 24; ++j)
      for (int k = 0; k < layers; ++k) points.push_back(Vec3d(3, -2, 1) + spacing * Vec3d(i, j, k));
  return points;
}

}  // namespace

TEST_CASE("particles: their spacing, in order and in disorder", "[caches]") {
  for (const double spacing : {0.01, 1.0, 250.0}) {
    INFO(spacing);
    const std::vector<Vec3d> ball = latticeIn({Vec3d(1, 2, 3), 6.0 * spacing}, spacing);
    CHECK(particleSpacing(floats(ball)) == Approx(spacing).epsilon(0.05));
    CHECK(particleSpacing(floats(jittered(ball, spacing, 0.5))) == Approx(spacing).epsilon(0.1));
    CHECK(particleSpacing(floats(jittered(ball, spacing, 1.0))) == Approx(spacing).epsilon(0.1));
    CHECK(particleSpacing(floats(slab(spacing, 12))) == Approx(spacing).epsilon(0.05));
    CHECK(particleSpacing(floats(jittered(slab(spacing, 12), spacing, 1.0))) == Approx(spacing).epsilon(0.1));
  }
}

TEST_CASE("particles: two bodies far apart, and drops around them, change nothing", "[caches]") {
  std::vector<Vec3d> points = latticeIn({Vec3d(0, 0, 0), 0.5}, 0.1);
  for (const Vec3d& x : latticeIn({Vec3d(40, 0, 0), 0.5}, 0.1)) points.push_back(x);
  for (int n = 0; n < 50; ++n) points.emplace_back(n, 20.0 * std::sin(n), 20.0 * std::cos(n));
  CHECK(particleSpacing(floats(points)) == Approx(0.1).epsilon(0.1));
}

TEST_CASE("particles: few of them", "[caches]") {
  CHECK(particleSpacing({}) == 0.0);
  CHECK(particleSpacing({Vec3f(1.0f)}) == 0.0);
  CHECK(particleSpacing({Vec3f(1.0f), Vec3f(1.0f), Vec3f(1.0f)}) == 0.0);
  const double two = particleSpacing({Vec3f(0.0f), Vec3f(1, 0, 0)});
  CHECK(two > 0.0);
  CHECK(std::isfinite(two));
  CHECK(surfaceOfParticles({}, 1.0).triangles.empty());
  CHECK(surfaceOfParticles({Vec3f(1.0f)}, 0.0).triangles.empty());
}

TEST_CASE("particles: the surface of a ball of them", "[caches]") {
  constexpr double kSpacing = 0.05;
  const Ball ball{Vec3d(0.3, -0.2, 5.0), 0.4};
  // Each stands for a cube of the spacing: together they have the ball's volume.
  const std::vector<Vec3d> lattice = latticeIn(ball, kSpacing);
  for (const std::vector<Vec3d>& points : {lattice, jittered(lattice, kSpacing, 0.5)}) {
    const SurfaceTriangles surface = surfaceOfParticles(floats(points), kSpacing);
    REQUIRE(surface.triangles.size() > 500);
    double sum = 0.0, largest = 0.0;
    for (const Vec3f& x : surface.points) {
      const double d = ball.distance(Vec3d(x));
      sum += d;
      largest = std::max(largest, std::abs(d));
    }
    CHECK(std::abs(sum / double(surface.points.size())) < 0.4 * kSpacing);
    CHECK(largest < kSpacing);
  }
}

TEST_CASE("particles: a flat surface lies half a spacing above the uppermost", "[caches]") {
  const SurfaceTriangles surface = surfaceOfParticles(floats(slab(0.1, 8)), 0.1);
  const double top = 1.0 + 0.7 + 0.05;
  int count = 0;
  for (const Vec3f& x : surface.points) {
    if (std::abs(x[0] - 4.95) > 1.0 || std::abs(x[1] + 0.85) > 0.6 || x[2] < 1.35) continue;
    CHECK(x[2] == Approx(top).margin(0.02));
    ++count;
  }
  CHECK(count > 50);
}

TEST_CASE("particles: a linear velocity field comes back, and beyond the outermost", "[caches]") {
  const auto field = [](const Vec3d& x) { return Vec3d(1.0 + x[1], 2.0 - x[2], 0.5 * x[0]); };
  const std::vector<Vec3d> points = latticeIn({Vec3d(0.3, 0.4, 0.5), 0.5}, 0.1);
  std::vector<float> velocity;
  for (const Vec3d& x : points)
    for (int axis = 0; axis < 3; ++axis) velocity.push_back(float(field(x)[axis]));
  const openvdb::Vec3SGrid::Ptr grid = velocityOfParticles(floats(points), velocity, 0.1);
  for (auto value = grid->cbeginValueOn(); value; ++value) {
    const Vec3d x = grid->indexToWorld(value.getCoord());
    const double error = (Vec3d(*value) - field(x)).length(), off = (x - Vec3d(0.3, 0.4, 0.5)).length() - 0.5;
    INFO(off << ": " << error);
    CHECK(error < (off < 0.05 ? 0.01 : 1.3 * off));
  }
  CHECK(grid->tree().isValueOn(openvdb::Coord(3 + 5 + 2, 4, 5)));
}
