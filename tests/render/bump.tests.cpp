#include "render/bump.h"
#include "render/path_tracer.h"
#include "shapes.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex::render;

namespace {

constexpr int kSide = 33;

// The unit square at z = 0.5, facing up, cut into triangles of one spacing, with the heights of a function.
template <typename Height>
fluidtex::texture::TexturedSurface sheet(const Height& height) {
  fluidtex::texture::TexturedSurface surface;
  surface.spacing = 1.0 / (kSide - 1);
  for (int j = 0; j < kSide; ++j) {
    for (int i = 0; i < kSide; ++i) {
      const Vec3f p(float(i) / (kSide - 1), float(j) / (kSide - 1), 0.5f);
      surface.positions.push_back(p);
      surface.normals.emplace_back(0.0f, 0.0f, 1.0f);
      surface.color.emplace_back(1.0f);
      surface.maps["height"].push_back(height(p));
      const std::uint32_t v = std::uint32_t(j * kSide + i);
      if (i + 1 == kSide || j + 1 == kSide) continue;
      surface.triangles.emplace_back(v, v + 1, v + kSide + 1);
      surface.triangles.emplace_back(v, v + kSide + 1, v + kSide);
    }
  }
  return surface;
}

double farthest(const std::vector<Vec3f>& a, const Vec3f& b) {
  double result = 0.0;
  for (const Vec3f& n : a) result = std::max<double>(result, (n - b).length());
  return result;
}

}  // namespace

TEST_CASE("bump: a slope leans the normals by its own angle, the height counted in spacings", "[render]") {
  auto surface = sheet([](const Vec3f& p) { return 0.5f * p[0] - 0.25f * p[1]; });
  // 8 spacings high is 0.25 m.
  const Vec3f leant = normalized(Vec3f(-0.25f * 0.5f, 0.25f * 0.25f, 1.0f));
  CHECK(farthest(bumpedNormals(surface, {"height", 8.0}), leant) < 1e-5);
  CHECK(farthest(bumpedNormals(surface, {"height", -8.0}), Vec3f(-leant[0], -leant[1], leant[2])) < 1e-5);
  // Where the texture is twice as large, its relief is too.
  surface.scale.assign(surface.positions.size(), 2.0f);
  CHECK(farthest(bumpedNormals(surface, {"height", 4.0}), leant) < 1e-5);
}

TEST_CASE("bump: only what slopes along the surface counts", "[render]") {
  auto surface = sheet([](const Vec3f&) { return 0.7f; });
  CHECK(farthest(bumpedNormals(surface, {"height", 8.0}), Vec3f(0.0f, 0.0f, 1.0f)) < 1e-6);
  const auto ball = [] {
    auto sphere = shapes::sphere(Vec3f(0.0f), 1.0f, 4, Vec4f(1.0f));
    sphere.spacing = 0.05;
    for (const Vec3f& p : sphere.positions) sphere.maps["height"].push_back(p[2]);
    return sphere;
  }();
  const std::vector<Vec3f> normals = bumpedNormals(ball, {"height", 4.0});
  for (std::size_t v = 0; v < normals.size(); ++v) {
    const Vec3f& n = ball.normals[v];
    const Vec3f slope = (Vec3f(0.0f, 0.0f, 1.0f) - n * n[2]) * 0.2f;
    REQUIRE((normals[v] - normalized(n - slope)).length() < 0.01f);
  }
}

TEST_CASE("bump: normals are taken as they are, or steeper, and also part by part from a file", "[render]") {
  auto surface = sheet([](const Vec3f&) { return 0.0f; });
  const Vec3f given = normalized(Vec3f(0.5f, 0.0f, 1.0f));
  surface.vectors["relief"].assign(surface.positions.size(), given);
  CHECK(farthest(bumpedNormals(surface, {"relief", 1.0}), given) < 1e-6);
  CHECK(farthest(bumpedNormals(surface, {"relief", 2.0}), normalized(Vec3f(1.0f, 0.0f, 1.0f))) < 1e-6);
  for (const auto& [name, value] :
       {std::pair{"relief_x", given[0]}, std::pair{"relief_y", given[1]}, std::pair{"relief_z", given[2]}})
    surface.maps[name].assign(surface.positions.size(), value);
  surface.vectors.clear();
  CHECK(farthest(bumpedNormals(surface, {"relief", 1.0}), given) < 1e-6);
}

TEST_CASE("bump: a map that is not there is an error", "[render]") {
  auto surface = sheet([](const Vec3f&) { return 0.0f; });
  CHECK_THROWS_AS(bumpedNormals(surface, {"other", 1.0}), std::invalid_argument);
  CHECK(hasMap(surface, {"height", 1.0}));
  CHECK_FALSE(hasMap(surface, {"other", 1.0}));
  surface.spacing = 0.0;
  CHECK_THROWS_AS(bumpedNormals(surface, {"height", 1.0}), std::invalid_argument);
  surface.normals.clear();
  CHECK_THROWS_AS(bumpedNormals(surface, {"height", 1.0}), std::invalid_argument);
}

TEST_CASE("bump: slopes towards the sun are brighter, those away from it darker", "[render]") {
  Options options = shapes::evenLight(32, 32, 64);
  options.light.skyColor = options.light.horizonColor = Vec3d(0.0);
  options.light.sunColor = Vec3d(1.0);
  options.light.sunDirection = Vec3d(1.0, 0.0, 1.0);
  options.camera.from = Vec3d(0.5, 0.5, 3.0);
  options.camera.at = Vec3d(0.5, 0.5, 0.5);
  options.camera.fov = 15.0;
  options.bounces = 0;
  // A ridge along y: its left side looks away from the sun.
  const auto surface = sheet([](const Vec3f& p) { return 1.0f - std::abs(2.0f * p[0] - 1.0f); });
  const Picture flat = shapes::traceRadiance(surface, {}, options, shapes::unitView());
  options.bump = {"height", 8.0};
  const Picture bumped = shapes::traceRadiance(surface, {}, options, shapes::unitView());
  const auto sunny = [](float slope) {  // of the normal (-slope, 0, 1)
    return (1.0f - slope) / std::sqrt(1.0f + slope * slope);
  };
  const float left = shapes::pixel(bumped, 8, 16)[0], right = shapes::pixel(bumped, 24, 16)[0];
  const float even = shapes::pixel(flat, 8, 16)[0];
  CHECK(left / even == Approx(sunny(0.5f)).epsilon(0.03));
  CHECK(right / even == Approx(sunny(-0.5f)).epsilon(0.03));
}

TEST_CASE("bump: a surface without the map is drawn without relief", "[render]") {
  auto surface = sheet([](const Vec3f& p) { return p[0]; });
  Options options = shapes::evenLight(16, 16, 4);
  const Picture flat = shapes::traceRadiance(surface, {}, options, shapes::unitView());
  options.bump = {"other", 8.0};
  CHECK((shapes::traceRadiance(surface, {}, options, shapes::unitView()).rgb == flat.rgb));
}
