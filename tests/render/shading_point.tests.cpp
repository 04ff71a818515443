#include "render/shading_point.h"
#include "render/sampling.h"
#include "shapes.h"

#include <catch2/catch.hpp>

using namespace fluidtex::render;

namespace {

Ray hitOn(std::uint32_t geometry, std::uint32_t triangle, float u, float v, const Vec3f& direction) {
  Ray ray{Vec3f(0.0f), direction};
  ray.geometry = geometry;
  ray.triangle = triangle;
  ray.u = u;
  ray.v = v;
  return ray;
}

}  // namespace

TEST_CASE("shading point: colours are linear inside a triangle", "[render]") {
  auto ball = shapes::sphere(Vec3f(0.0f), 1.0f, 0, Vec4f(0.0f));
  for (std::size_t i = 0; i < ball.positions.size(); ++i) {
    const Vec3f p = ball.positions[i] * 0.4f + Vec3f(0.5f);
    ball.color[i] = Vec4f(p[0], p[1], p[2], 1.0f);
  }
  Stage stage;
  stage.liquid = &ball;
  for (std::uint32_t t = 0; t < ball.triangles.size(); ++t) {
    const ShadingPoint point =
        shadingPoint(stage, hitOn(kLiquid, t, 0.2f, 0.5f, -ball.normals[ball.triangles[t][0]]));
    REQUIRE((point.material.base - (point.position * 0.4f + Vec3f(0.5f))).length() < 1e-6f);
  }
}

TEST_CASE("shading point: normals are smooth and on the viewer's side", "[render]") {
  const auto ball = shapes::sphere(Vec3f(0.0f), 1.0f, 2, Vec4f(1.0f));
  Stage stage;
  stage.liquid = &ball;
  for (std::uint32_t t = 0; t < ball.triangles.size(); t += 7) {
    const Vec3f outward = ball.normals[ball.triangles[t][0]];
    const ShadingPoint outside = shadingPoint(stage, hitOn(kLiquid, t, 0.3f, 0.3f, -outward));
    REQUIRE(outside.normal.dot(outside.position / outside.position.length()) > 0.9999f);
    REQUIRE(outside.faceNormal.dot(outward) > 0.9f);
    const ShadingPoint inside = shadingPoint(stage, hitOn(kLiquid, t, 0.3f, 0.3f, outward));
    REQUIRE((inside.normal + outside.normal).length() < 1e-6f);
  }
}

TEST_CASE("shading point: a normal that looks away from the viewer is turned", "[render]") {
  auto ball = shapes::sphere(Vec3f(0.0f), 1.0f, 0, Vec4f(1.0f));
  Stage stage;
  stage.liquid = &ball;
  for (auto& n : ball.normals) n = Vec3f(1.0f, 0.0f, 0.0f);
  const Vec3f direction = normalized(Vec3f(1.0f, 0.1f, 0.2f));
  for (std::uint32_t t = 0; t < ball.triangles.size(); ++t)
    REQUIRE(shadingPoint(stage, hitOn(kLiquid, t, 0.3f, 0.3f, direction)).normal.dot(direction) < 0.0f);
}

TEST_CASE("shading point: rays leave from the smooth surface, not from the facet", "[render]") {
  const auto ball = shapes::sphere(Vec3f(0.0f), 1.0f, 1, Vec4f(1.0f));
  Stage stage;
  stage.liquid = &ball;
  for (std::uint32_t t = 0; t < ball.triangles.size(); ++t) {
    const ShadingPoint point =
        shadingPoint(stage, hitOn(kLiquid, t, 1.0f / 3, 1.0f / 3, -ball.normals[ball.triangles[t][0]]));
    const float sag = 1.0f - point.position.length();
    REQUIRE(sag > 0.01f);
    REQUIRE(point.origin.length() > 1.0f - 0.2f * sag);
    REQUIRE((point.origin - point.position).length() < 3.0f * sag);
  }
}

TEST_CASE("shading point: opacity is the liquid's alpha, 1 for solids, and fades on the ground", "[render]") {
  auto ball = fluidtex::render::shapes::sphere(Vec3f(0.0f), 1.0f, 0, Vec4f(0.5f, 0.5f, 0.5f, 0.25f));
  Stage stage;
  stage.liquid = &ball;
  stage.meshes.push_back(
      {MeshKind::ground, {{-90, -90, 0}, {90, -90, 0}, {0, 90, 0}}, {{0, 1, 2}}, Vec3f(0.5f)});
  stage.meshes.push_back(
      {MeshKind::matt, {{-90, -90, 0}, {90, -90, 0}, {0, 90, 0}}, {{0, 1, 2}}, Vec3f(0.5f)});
  const Vec3f down(0.0f, 0.0f, -1.0f);
  REQUIRE(liquidOpacity(stage, hitOn(kLiquid, 0, 0.2f, 0.3f, down)) == Approx(0.25f));
  REQUIRE(liquidOpacity(stage, hitOn(2, 0, 0.0f, 0.0f, down)) == 1.0f);
  REQUIRE(shadingPoint(stage, hitOn(1, 0, 0.0f, 0.0f, down)).opacity == 0.0f);
  REQUIRE(shadingPoint(stage, hitOn(1, 0, 0.25f, 0.5f, down)).opacity == 1.0f);
  REQUIRE(shadingPoint(stage, hitOn(2, 0, 0.0f, 0.0f, down)).opacity == 1.0f);
}

TEST_CASE("shading point: the colour of a corner that is not there does not show", "[render]") {
  auto ball = fluidtex::render::shapes::sphere(Vec3f(0.0f), 1.0f, 0, Vec4f(0.2f, 0.4f, 0.6f, 1.0f));
  ball.color[ball.triangles[0][1]] = Vec4f(1.0f, 0.0f, 1.0f, 0.0f);
  Stage stage;
  stage.liquid = &ball;
  const Vec4f inside = liquidColor(stage, 0, Vec3f(0.25f, 0.5f, 0.25f));
  REQUIRE((inside - Vec4f(0.2f, 0.4f, 0.6f, 0.5f)).length() < 1e-6f);
  REQUIRE(liquidColor(stage, 0, Vec3f(0.0f, 1.0f, 0.0f))[3] == 0.0f);
}

TEST_CASE("shading point: what is looked up between vertices goes before their colours", "[render]") {
  const auto ball = fluidtex::render::shapes::sphere(Vec3f(0.0f), 1.0f, 0, Vec4f(0.2f, 0.4f, 0.6f, 1.0f));
  Stage stage;
  stage.liquid = &ball;
  stage.colorBetween = [](std::uint32_t triangle, const Vec3f& weights) -> std::optional<Vec4f> {
    if (triangle != 1) return std::nullopt;
    return Vec4f(weights[0], weights[1], weights[2], 0.5f);
  };
  REQUIRE(liquidColor(stage, 0, Vec3f(0.25f, 0.5f, 0.25f)) == Vec4f(0.2f, 0.4f, 0.6f, 1.0f));
  REQUIRE(liquidColor(stage, 1, Vec3f(0.25f, 0.5f, 0.25f)) == Vec4f(0.25f, 0.5f, 0.25f, 0.5f));
  REQUIRE(liquidOpacity(stage, hitOn(kLiquid, 1, 0.5f, 0.25f, Vec3f(0.0f, 0.0f, -1.0f))) == 0.5f);
}
