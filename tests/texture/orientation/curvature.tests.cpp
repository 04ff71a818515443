#include "texture/orientation/curvature.h"

#include "tests/texture/mesh/closed_meshes.h"

#include <catch2/catch.hpp>

using namespace fluidtex::texture;
using namespace fluidtex::testing;

TEST_CASE("curvature: one over the radius on a ball of any size, below 0 seen from inside") {
  const double radius = GENERATE(0.01, 1.0, 300.0);
  SurfaceMesh mesh = sphereMesh(16, radius);
  for (const float c : meanCurvature(mesh)) CHECK(c == Approx(1.0 / radius).epsilon(1e-3));
  for (Vec3f& n : mesh.normals) n = -n;
  for (const float c : meanCurvature(mesh)) CHECK(c == Approx(-1.0 / radius).epsilon(1e-3));
}

TEST_CASE("curvature: half of one over the radius around a tube") {
  // A long ellipsoid is a tube in its middle.
  SurfaceMesh mesh = sphereMesh(40);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    Vec3f& x = mesh.positions[v];
    mesh.normals[v] = Vec3f(x.x(), x.y(), x.z() / 6.0f);
    mesh.normals[v].normalize();
    x[2] *= 6.0f;
  }
  const std::vector<float> curvature = meanCurvature(mesh);
  double sum = 0.0;
  int count = 0;
  for (std::size_t v = 0; v < curvature.size(); ++v) {
    if (std::abs(mesh.positions[v].z()) > 0.6f) continue;
    sum += double(curvature[v]), ++count;
  }
  REQUIRE(count > 100);
  CHECK(sum / count == Approx(0.5 * (1.0 + 1.0 / 36.0)).epsilon(0.1));
}
