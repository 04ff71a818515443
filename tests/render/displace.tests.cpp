#include "render/displace.h"
#include "shapes.h"

#include <catch2/catch.hpp>

#include <stdexcept>

using namespace fluidtex;
using namespace fluidtex::render;
using namespace fluidtex::render::shapes;

namespace {

// A ball of radius 0.4 with values that grow with height, of spacing 0.01.
texture::TexturedSurface ball() {
  auto surface = sphere(Vec3f(0.0f), 0.4f, 4, Vec4f(1.0f));
  surface.spacing = 0.01;
  for (const Vec3f& p : surface.positions) surface.maps["height"].push_back(p[2]);
  return surface;
}

}  // namespace

TEST_CASE("displacement: moves the surface along its normals and tilts them", "[render]") {
  const auto surface = ball();
  const auto moved = displaced(surface, {"height", 5.0});
  REQUIRE(moved.triangles.size() == surface.triangles.size());
  for (std::size_t v = 0; v < moved.positions.size(); ++v) {
    const float away = 5.0f * 0.01f * surface.positions[v][2];
    REQUIRE((moved.positions[v] - surface.positions[v] - surface.normals[v] * away).length() < 1e-6f);
    REQUIRE(moved.normals[v].length() == Approx(1.0f));
  }
  // Normals are those of the mesh that came out, but for its facets.
  for (const texture::Vec3I& t : moved.triangles) {
    const Vec3f &a = moved.positions[t[0]], &b = moved.positions[t[1]], &c = moved.positions[t[2]];
    Vec3f face = (b - a).cross(c - a);
    face.normalize();
    for (int k = 0; k < 3; ++k) REQUIRE(face.dot(moved.normals[t[k]]) > 0.99f);
  }
}

TEST_CASE("displacement: what touches a solid stays, and spacing counts place by place", "[render]") {
  auto surface = ball();
  surface.maps["height"].assign(surface.positions.size(), 1.0f);
  surface.contact.assign(surface.positions.size(), 0);
  surface.contact[3] = 1;
  surface.scale.assign(surface.positions.size(), 1.0f);
  surface.scale[4] = 2.0f;
  const auto moved = displaced(surface, {"height", 1.0});
  CHECK(moved.positions[3] == surface.positions[3]);
  CHECK((moved.positions[4] - surface.positions[4]).length() == Approx(0.02f));
  CHECK((moved.positions[5] - surface.positions[5]).length() == Approx(0.01f));
}

TEST_CASE("displacement: changes the outline, as relief does not", "[render]") {
  auto surface = ball();
  surface.maps["height"].assign(surface.positions.size(), 1.0f);
  Options options = evenLight(64, 64, 4);
  options.camera.from = Vec3d(0.0, -4.0, 0.0);
  options.camera.at = Vec3d(0.0);
  options.camera.fov = 20.0;
  for (Vec4f& color : surface.color) color = Vec4f(0.0f, 0.0f, 0.0f, 1.0f);
  const auto dark = [&] {
    int count = 0;
    for (const float value : traceRadiance(surface, {}, options, unitView()).rgb) count += value < 0.5f;
    return count;
  };
  const int before = dark();
  options.bump = {"height", 10.0};
  CHECK(dark() == before);
  options.displacement = {"height", 10.0};  // 0.1 m more
  CHECK(double(dark()) / before == Approx(25.0 / 16.0).epsilon(0.05));
  options.displacement.map = "none";
  CHECK(dark() == before);
}

TEST_CASE("displacement: a surface without the map is refused", "[render]") {
  CHECK_THROWS_AS(displaced(ball(), {"depth", 1.0}), std::invalid_argument);
}
