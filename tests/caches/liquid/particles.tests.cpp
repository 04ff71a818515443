#include "caches/liquid/particles.h"

#include "caches/liquid/particle_velocity.h"
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

TEST_CASE("particles: linear velocities come back, in the bulk and above a flat surface", "[caches]") {
  // A turn, a shear and a stretching at once.
  const auto field = [](const Vec3d& x) {
    return Vec3d(1.0 + 2.0 * x[1] - x[2], 2.0 - x[2] - 0.7 * x[0], 0.5 * x[0] + 0.3 * x[2]);
  };
  const std::vector<Vec3d> even = slab(0.1, 8);
  for (const std::vector<Vec3d>& points : {even, jittered(even, 0.1, 1.0)}) {
    std::vector<float> velocity;
    for (const Vec3d& x : points)
      for (int axis = 0; axis < 3; ++axis) velocity.push_back(float(field(Vec3d(Vec3f(x)))[axis]));
    const openvdb::Vec3SGrid::Ptr grid = velocityOfParticles(floats(points), velocity, 0.1);
    int inside = 0, above = 0;
    for (auto value = grid->cbeginValueOn(); value; ++value) {
      const Vec3d x = grid->indexToWorld(value.getCoord());
      // To 1.2 spacings above the uppermost: the surface is half a spacing above, and lies between voxels.
      if (std::abs(x[0] - 4.95) > 1.8 || std::abs(x[1] + 0.85) > 1.0 || x[2] < 1.0 || x[2] > 1.82) continue;
      const double error = (Vec3d(*value) - field(x)).length();
      INFO(x << ": " << error);
      CHECK(error < 1e-4 * field(x).length());
      ++(x[2] > 1.7 ? above : inside);
    }
    CHECK(inside > 3000);
    CHECK(above > 300);
  }
}

TEST_CASE("particles: of one velocity all around", "[caches]") {
  const std::vector<Vec3d> points = slab(0.1, 4);
  std::vector<float> velocity;
  for (std::size_t n = 0; n < points.size(); ++n)
    for (const float v : {0.3f, 0.0f, -0.41f}) velocity.push_back(v);
  const openvdb::Vec3SGrid::Ptr grid = velocityOfParticles(floats(points), velocity, 0.1);
  REQUIRE(grid->activeVoxelCount() > points.size());
  for (auto value = grid->cbeginValueOn(); value; ++value)
    CHECK((*value - Vec3f(0.3f, 0.0f, -0.41f)).length() < 1e-6f);
}

TEST_CASE("particles: of jets that cross, with noise, nothing is faster than the fastest", "[caches]") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<Vec3f> points;
  std::vector<float> velocity;
  double fastest = 0.0;
  for (int n = 0; n < 12000; ++n) {
    // Threads of 3 spacings across along x and along y, and one of twenty a drop somewhere around.
    const double along = unit(random), a = 0.06 * unit(random), b = 0.06 * unit(random);
    const bool isDrop = n % 20 == 0;
    const Vec3d x = isDrop       ? Vec3d(unit(random), unit(random), 0.3 * unit(random))
                    : n % 2 == 0 ? Vec3d(along, a, b)
                                 : Vec3d(a, along, b + 0.03);
    const Vec3d v = (n % 2 == 0 ? Vec3d(5, 0, 0) : Vec3d(0, 4, 0)) +
                    Vec3d(unit(random), unit(random), unit(random)) * (isDrop ? 4.0 : 1.0);
    points.emplace_back(x);
    for (int axis = 0; axis < 3; ++axis) velocity.push_back(float(v[axis]));
    fastest = std::max(fastest, v.length());
  }
  for (const double spacing : {0.02, 0.035, 0.06}) {
    const openvdb::Vec3SGrid::Ptr grid = velocityOfParticles(points, velocity, spacing);
    double most = 0.0;
    for (auto value = grid->cbeginValueOn(); value; ++value) most = std::max(most, double(value->length()));
    INFO(spacing << ": " << most << " of " << fastest);
    CHECK(most < 1.05 * fastest);
    CHECK(most > 4.0);
  }
}

TEST_CASE("particles: a layer at a wall that keeps another velocity does not lead the liquid", "[caches]") {
  std::vector<float> velocity;
  const std::vector<Vec3d> points = jittered(slab(0.1, 8), 0.1, 0.6);
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 0.1);
  for (const Vec3d& x : points)
    for (const double v : {x[2] < 1.05 ? 10.0 : 1.0, 0.0, 0.0}) velocity.push_back(float(v + noise(random)));
  const openvdb::Vec3SGrid::Ptr grid = velocityOfParticles(floats(points), velocity, 0.1);
  int count = 0;
  for (auto value = grid->cbeginValueOn(); value; ++value) {
    const Vec3d x = grid->indexToWorld(value.getCoord());
    if (std::abs(x[0] - 4.95) > 1.5 || std::abs(x[1] + 0.85) > 0.8 || x[2] < 0.9 || x[2] > 1.9) continue;
    INFO(x << ": " << *value);
    CHECK((*value)[0] == Approx(1.0).margin(0.35));
    ++count;
  }
  CHECK(count > 1000);
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
