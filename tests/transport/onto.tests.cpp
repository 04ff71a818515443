#include "transport/onto.h"

#include "tests/transport/textured_meshes.h"

#include <stdexcept>

using namespace fluidtex;
using namespace fluidtex::testing;

namespace {

TexturedSurface finished(const SurfaceMesh& mesh) {
  TexturedSurface surface = texturedMesh(mesh, constantDirection({0.3, 0.5, 0.8}));
  const std::size_t count = mesh.positions.size();
  surface.velocity.assign(count, Vec3f(1, 2, 3));
  surface.contact.assign(count, 0);
  surface.maps["height"].resize(count);
  for (std::size_t v = 0; v < count; ++v) surface.maps["height"][v] = mesh.positions[v].x();
  surface.vectors["fibre"] = surface.orientation;
  surface.exemplarWidth = 64;
  surface.exemplarHeight = 32;
  for (Vec3f& x : surface.previousPosition) x -= Vec3f(0.5f, 0, 0);
  return surface;
}

}  // namespace

TEST_CASE("onto a mesh: every vertex gets every map of the closest place", "[transport]") {
  const TexturedSurface surface = finished(sphereMesh(30));
  const SurfaceMesh mesh = sphereMesh(7, 1.01);
  const TexturedSurface result = transport::onto(surface, mesh.positions, mesh.triangles);
  REQUIRE(result.positions == mesh.positions);
  REQUIRE(result.triangles == mesh.triangles);
  CHECK(result.exemplarWidth == 64);
  CHECK(result.exemplarHeight == 32);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec3f place = mesh.positions[v] / 1.01f;
    REQUIRE(result.normals[v].dot(mesh.normals[v]) > 0.99f);
    REQUIRE((result.coordinate[v] - Vec2f(place.x(), place.y()) * float(kTexelsPerMeter)).length() < 0.1f);
    REQUIRE(result.color[v][1] == Approx(0.5 + 0.1 * place.y()).margin(1e-3));
    REQUIRE(result.age[v] == Approx(2.0 + place.z()).margin(5e-3));
    REQUIRE(result.maps.at("height")[v] == Approx(place.x()).margin(5e-3));
    REQUIRE((result.velocity[v] - Vec3f(1, 2, 3)).length() < 1e-5f);
    REQUIRE((result.previousPosition[v] - (mesh.positions[v] - Vec3f(0.5f, 0, 0))).length() < 1e-4f);
    REQUIRE(std::abs(result.orientation[v].dot(result.normals[v])) < 1e-5f);
    REQUIRE(result.orientation[v].length() == Approx(1.0f));
    REQUIRE(result.trust[v] > 0.5f);
    const Vec3f& fibre = result.vectors.at("fibre")[v];
    REQUIRE(fibre.length() == Approx(1.0f));
    // The field has two poles, beside which corners differ much.
    if (std::abs(place.dot(Vec3f(0.3f, 0.5f, 0.8f))) < 0.8f)
      REQUIRE(fibre.dot(result.orientation[v]) > 0.99f);
  }
}

TEST_CASE("onto a mesh: what fades goes along", "[transport]") {
  TexturedSurface surface = finished(sphereMesh(30));
  surface.fading = texture::noFading(surface.positions.size());
  const Vec2f elsewhere(7.0f, -3.0f);
  for (std::size_t v = 0; v < surface.positions.size(); ++v) {
    surface.fading.coordinate[v] = surface.coordinate[v] + elsewhere;
    surface.fading.gradient[v] = surface.gradient[v];
    surface.fading.weight[v] = surface.positions[v].z() > 0.0f ? 0.75f : 0.0f;
    surface.fading.speed[v] = 2.0f;
  }
  const SurfaceMesh mesh = sphereMesh(7, 1.01);
  const TexturedSurface result = transport::onto(surface, mesh.positions, mesh.triangles);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const float height = mesh.positions[v].z();
    if (height < -0.1f) CHECK(result.fading.weight[v] == 0.0f);
    if (height < 0.1f) continue;
    CHECK(result.fading.weight[v] == 0.75f);
    CHECK(result.fading.speed[v] == 2.0f);
    CHECK((result.fading.coordinate[v] - result.coordinate[v] - elsewhere).length() < 1e-3f);
    CHECK((result.fading.gradient[v].s - result.gradient[v].s).length() < 1e-3f);
  }
}

TEST_CASE("onto a mesh: open meshes and far ones get values too, far ones no trust", "[transport]") {
  const TexturedSurface surface = finished(sphereMesh(10));
  const std::vector<Vec3f> triangle{{2, 0, 0}, {2, 1, 0}, {2, 0, 1}};
  const TexturedSurface result = transport::onto(surface, triangle, {Vec3I(0, 1, 2)});
  for (std::size_t v = 0; v < 3; ++v) {
    CHECK((result.normals[v] - Vec3f(1, 0, 0)).length() < 1e-6f);
    CHECK(result.trust[v] < 1e-6f);
    CHECK(result.color[v][0] > 0.55f);
  }
}

TEST_CASE("onto a mesh: nothing to take from, no vertices, and bad triangles", "[transport]") {
  const SurfaceMesh mesh = sphereMesh(3);
  const TexturedSurface plain = transport::onto({}, mesh.positions, mesh.triangles);
  CHECK(plain.trust == std::vector<float>(mesh.positions.size(), 0.0f));
  CHECK(plain.color.size() == mesh.positions.size());
  CHECK(transport::onto(finished(mesh), {}, {}).empty());
  CHECK_THROWS_AS(transport::onto(finished(mesh), mesh.positions, {Vec3I(0, 1, 9999)}),
                  std::invalid_argument);
}
