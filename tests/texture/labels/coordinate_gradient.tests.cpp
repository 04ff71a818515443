#include "texture/labels/coordinate_gradient.h"

#include "tests/texture/orientation/oriented_mesh.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

using namespace fluidtex::texture;
using namespace fluidtex::testing;

namespace {

// A flat box whose coordinate is linear in x and y on its upper side: s = 2 x + 0.5 y, t = -y; another piece
// from x = 8 on.
TexturedSurface linear(const OrientedMesh& box) {
  TexturedSurface surface;
  static_cast<SurfaceMesh&>(surface) = box.mesh;
  for (const Vec3f& x : box.mesh.positions)
    surface.coordinate.emplace_back(2.0f * x.x() + 0.5f * x.y() + (x.x() > 8.0f ? 100.0f : 0.0f), -x.y());
  surface.exemplarWidth = surface.exemplarHeight = 400;
  return surface;
}

}  // namespace

TEST_CASE("coordinate gradient: distortion is the worse of the singular values") {
  CHECK(distortion({1, 0, 0, 1}) == Approx(1.0f));
  CHECK(distortion({0, -2, 2, 0}) == Approx(2.0f));
  CHECK(distortion({0.25f, 0, 0, 1}) == Approx(4.0f));
  CHECK(distortion({1, 0, 1, 0}) == std::numeric_limits<float>::infinity());
  const Vec2f l = times({1, 2, 3, 4}, Vec2f(1.0f, -1.0f));
  CHECK(l == Vec2f(-1.0f, -1.0f));
}

TEST_CASE("coordinate gradient: that of a linear map, up to the joint of two pieces") {
  const OrientedMesh box = flatBox(16);
  const TexturedSurface surface = linear(box);
  const Coordinates coordinates{surface, box.graph};
  const auto gradients = fittedGradients(coordinates);
  const std::uint32_t v = nearestVertex(box.mesh, Vec3f(5, 8, 2)),
                      u = nearestVertex(box.mesh, Vec3f(6, 8, 2)),
                      edge = nearestVertex(box.mesh, Vec3f(8, 8, 2)),
                      beyond = nearestVertex(box.mesh, Vec3f(9, 8, 2));
  REQUIRE(gradients[v]);
  // The axes are whatever they are; what the map says of a step is not.
  for (const Vec3f& step : {Vec3f(1, 0, 0), Vec3f(0, 1, 0)}) {
    const Vec2f said = times(*gradients[v], coordinates.local(v, box.mesh.positions[v] + step));
    CHECK((said - Vec2f(2.0f * step.x() + 0.5f * step.y(), -step.y())).length() < 1e-3f);
  }
  CHECK(cohere(coordinates, gradients, v, u));
  CHECK_FALSE(cohere(coordinates, gradients, edge, beyond));
}

TEST_CASE("coordinate gradient: on an exemplar that wraps the shorter way counts") {
  const OrientedMesh box = flatBox(4);
  TexturedSurface surface = linear(box);
  surface.exemplarWidth = 100;
  surface.exemplarHeight = 50;
  const Coordinates plain{surface, box.graph}, wraps{surface, box.graph, true};
  CHECK(plain.difference({99.0f, 1.0f}, {1.0f, 49.0f}) == Vec2f(98.0f, -48.0f));
  CHECK(wraps.difference({99.0f, 1.0f}, {1.0f, 49.0f}) == Vec2f(-2.0f, 2.0f));
}
