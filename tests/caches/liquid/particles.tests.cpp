#include "caches/liquid/particles.h"

#include "tests/caches/liquid/flows.h"
#include "tests/caches/liquid/particle_slabs.h"

#include <catch2/catch.hpp>

using namespace fluidtex::caches;
using openvdb::Vec3f;

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

TEST_CASE("particles: one alone and a few are drops, and a gap of three spacings stays open", "[caches]") {
  const SurfaceTriangles drop = surfaceOfParticles({Vec3f(0.31f, 0.2f, 7.0f)}, 0.1);
  REQUIRE(drop.triangles.size() > 7);
  for (const Vec3f& x : drop.points) CHECK((x - Vec3f(0.31f, 0.2f, 7.0f)).length() < 0.1f);
  std::vector<Vec3d> points = slab(0.1, 6);
  for (const Vec3d& x : slab(0.1, 6)) points.push_back(x + Vec3d(0, 0, 0.5 + 0.3));
  int above = 0;
  for (const Vec3f& x : surfaceOfParticles(floats(points), 0.1).points) {
    if (std::abs(x[0] - 4.95) > 1.0 || std::abs(x[1] + 0.85) > 0.6 || x[2] < 1.45 || x[2] > 1.85) continue;
    CHECK(std::abs(x[2] - 1.65) > 0.04);
    ++above;
  }
  CHECK(above > 50);
}
