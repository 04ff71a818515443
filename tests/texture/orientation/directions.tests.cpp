#include "texture/orientation/directions.h"

#include "tests/texture/mesh/closed_meshes.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

using namespace fluidtex::texture;
using namespace fluidtex::testing;

TEST_CASE("directions: along the flow, and little where it is still", "[texture]") {
  const SurfaceMesh mesh = sphereMesh(8);
  std::vector<Vec3f> velocity;
  for (const Vec3f& x : mesh.positions)
    velocity.push_back(x.z() > 0.0f ? Vec3f(10, 0, 0) : Vec3f(0.01f, 0, 0));
  const std::vector<Vec3f> along = alongFlow(mesh, velocity, 0.1);
  for (std::size_t v = 0; v < along.size(); ++v) {
    CHECK(std::abs(along[v].dot(mesh.normals[v])) < 1e-5f);
    if (std::abs(mesh.normals[v].x()) < 0.5f) {
      if (mesh.positions[v].z() > 0.0f)
        CHECK(along[v].length() > 0.99f);
      else
        CHECK(along[v].length() < 0.11f);
    }
  }
}

TEST_CASE("directions: the surface bends around a thin torus' tube, and nowhere on a plane", "[texture]") {
  const SurfaceMesh torus = torusMesh(96, 24, 1.0, 0.25);
  const std::vector<Vec3f> bend = alongBend(torus);
  for (std::size_t v = 0; v < bend.size(); ++v) {
    const Vec3f& x = torus.positions[v];
    const Vec3f along(-x.y(), x.x(), 0.0f);  // the tube's own direction
    REQUIRE(bend[v].length() > 0.3f);
    CHECK(std::abs(bend[v].unit().dot(along.unit())) < 0.02f);
  }
  const SurfaceMesh box = boxMesh({0, 0, 0}, {1, 1, 1}, {10, 10, 10});
  const std::vector<Vec3f> flat = alongBend(box);
  for (std::size_t v = 0; v < flat.size(); ++v) {
    const Vec3f& x = box.positions[v];
    const bool inner = std::abs(x.x() - 0.5f) < 0.15f && std::abs(x.y() - 0.5f) < 0.15f;
    if (inner) CHECK(flat[v].length() < 1e-4f);
  }
}

TEST_CASE("directions: vectors of a grid", "[texture]") {
  openvdb::initialize();
  const auto grid = openvdb::Vec3SGrid::create(Vec3f(0.0f, 3.0f, 0.0f));
  const SurfaceMesh mesh = sphereMesh(6);
  const std::vector<Vec3f> along = alongField(mesh, *grid);
  const std::vector<Vec3f> expected = alongDirection(mesh, Vec3f(0.0f, 1.0f, 0.0f));
  for (std::size_t v = 0; v < along.size(); ++v) CHECK((along[v] - expected[v]).length() < 1e-6f);
}

TEST_CASE("directions: along one, with the square of the sine as confidence, whatever its length",
          "[texture]") {
  const SurfaceMesh mesh = sphereMesh(8);
  const Vec3f unit = Vec3f(1.0f, -2.0f, 0.5f).unit();
  for (const float length : {1e-3f, 1.0f, 500.0f}) {
    const std::vector<Vec3f> along = alongDirection(mesh, unit * length);
    REQUIRE(along.size() == mesh.positions.size());
    for (std::size_t v = 0; v < along.size(); ++v) {
      const Vec3f& n = mesh.normals[v];
      const float cosine = n.dot(unit), square = 1.0f - cosine * cosine;
      CHECK(std::abs(along[v].dot(n)) < 1e-5f);
      CHECK(along[v].length() == Approx(square).margin(1e-5));
      CHECK(along[v].dot(unit) == Approx(std::pow(square, 1.5f)).margin(1e-5));
    }
  }
  for (const Vec3f& x : alongDirection(mesh, Vec3f(0.0f))) CHECK(x == Vec3f(0.0f));
}

TEST_CASE("directions: along the flow, what is seen of it counts, and at the speed of stillness half",
          "[texture]") {
  const SurfaceMesh box = boxMesh({0, 0, 0}, {1, 1, 1}, {4, 4, 4});
  // Mostly into the upper side.
  const std::vector<Vec3f> velocity(box.positions.size(), Vec3f(0.3f, 0.4f, -20.0f));
  const std::vector<Vec3f> along = alongFlow(box, velocity, 0.5), fast = alongFlow(box, velocity, 0.05);
  int upper = 0;
  for (std::size_t v = 0; v < along.size(); ++v) {
    if (box.normals[v].z() < 0.999f) continue;
    ++upper;
    CHECK((along[v] - Vec3f(0.6f, 0.8f, 0.0f) * 0.5f).length() < 1e-6f);
    CHECK((fast[v] - Vec3f(0.6f, 0.8f, 0.0f) * (100.0f / 101.0f)).length() < 1e-6f);
  }
  CHECK(upper == 9);
  for (const Vec3f& x : alongFlow(box, std::vector<Vec3f>(box.positions.size(), Vec3f(0.0f)), 0.5))
    CHECK(x == Vec3f(0.0f));
}

TEST_CASE("directions: along vectors, of which those that are none have no say", "[texture]") {
  const SurfaceMesh mesh = sphereMesh(4);
  const float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  std::vector<Vec3f> vectors;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec3f own(std::cos(float(v)), std::sin(float(v)), 0.3f);
    const Vec3f none[] = {Vec3f(0.0f), Vec3f(nan, 1, 0), Vec3f(0, inf, 0)};
    vectors.push_back(v % 2 == 0 ? own * float(v + 1) : none[v / 2 % 3]);
  }
  const std::vector<Vec3f> along = alongVectors(mesh, vectors);
  REQUIRE(along.size() == vectors.size());
  for (std::size_t v = 0; v < along.size(); ++v) {
    if (v % 2 == 0)
      CHECK((along[v] - alongDirection(mesh, vectors[v])[v]).length() < 1e-6f);
    else
      CHECK(along[v] == Vec3f(0.0f));
  }
}

TEST_CASE("directions: a grid is read linearly between its nodes", "[texture]") {
  openvdb::initialize();
  const auto grid = openvdb::Vec3SGrid::create(Vec3f(0.0f));
  grid->setTransform(openvdb::math::Transform::createLinearTransform(0.25));
  const auto vectorAt = [](const Vec3f& x) { return Vec3f(1.0f + x.y(), 2.0f * x.x(), x.z() - 0.5f); };
  auto accessor = grid->getAccessor();
  for (int i = -6; i <= 6; ++i)
    for (int j = -6; j <= 6; ++j)
      for (int k = -6; k <= 6; ++k)
        accessor.setValue({i, j, k}, vectorAt(0.25f * Vec3f(float(i), float(j), float(k))));
  const SurfaceMesh mesh = sphereMesh(6);
  std::vector<Vec3f> vectors;
  for (const Vec3f& x : mesh.positions) vectors.push_back(vectorAt(x));
  const std::vector<Vec3f> along = alongField(mesh, *grid), expected = alongVectors(mesh, vectors);
  for (std::size_t v = 0; v < along.size(); ++v) CHECK((along[v] - expected[v]).length() < 1e-4f);
  // Nothing where the grid has nothing.
  for (const Vec3f& x : alongField(sphereMesh(3, 1.0, {50, 0, 0}), *grid)) CHECK(x == Vec3f(0.0f));
}

TEST_CASE("directions: the bend's confidence is by its radius in spacings", "[texture]") {
  // A torus bends by 1/r around its tube, and along it by cos / (R + r cos).
  const double major = 4.0, minor = 0.5;
  const SurfaceMesh torus = torusMesh(320, 40, major, minor);
  const std::vector<Vec3f> bend = alongBend(torus);
  for (std::size_t v = 0; v < bend.size(); ++v) {
    const Vec3f& x = torus.positions[v];
    const double from = std::hypot(x.x(), x.y());
    const double difference = 1.0 / minor - std::abs(from - major) / minor / from;
    const double strength = 20.0 * torus.spacing * difference;
    CHECK(bend[v].length() == Approx(strength / (1.0 + strength)).epsilon(0.02));
    CHECK(std::abs(bend[v].dot(torus.normals[v])) < 1e-5f);
  }
  // A ball bends alike in all directions, whatever its size.
  for (const double radius : {0.1, 10.0})
    for (const Vec3f& x : alongBend(sphereMesh(16, radius))) CHECK(x.length() < 0.15f);
}
