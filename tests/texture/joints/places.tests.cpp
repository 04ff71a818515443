#include "texture/joints/places.h"

#include "tests/texture/joints/sheets.h"

#include <catch2/catch.hpp>

using namespace fluidtex::texture;
using namespace fluidtex::testing;

namespace {

// Of an exemplar of 64 x 48 texels.
Torus torusOf(bool toroidal) {
  TexturedSurface surface;
  surface.exemplarWidth = 64, surface.exemplarHeight = 48;
  return {surface, toroidal};
}

}  // namespace

TEST_CASE("places: brought onto a toroidal exemplar, the share of its size is from 0 to 1") {
  const Torus torus = torusOf(true);
  CHECK(torus.brought({10.25f, 47.0f}) == Vec2f(10.25f, 47.0f));
  CHECK(torus.brought({64.0f, 48.0f}) == Vec2f(0.0f, 0.0f));
  CHECK(torus.brought({-0.5f, -0.75f}) == Vec2f(-0.5f, 47.25f));
  CHECK(torus.brought({63.5f, 47.25f}) == Vec2f(-0.5f, 47.25f));
  CHECK(torus.brought({-190.0f, 483.0f}) == Vec2f(2.0f, 3.0f));
}

TEST_CASE("places: brought onto an exemplar with an edge, they end at it") {
  const Torus plain = torusOf(false);
  CHECK(plain.brought({10.25f, 47.0f}) == Vec2f(10.25f, 47.0f));
  CHECK(plain.brought({-3.0f, 100.0f}) == Vec2f(-0.5f, 47.5f));
  CHECK(plain.brought({63.75f, -0.25f}) == Vec2f(63.5f, -0.25f));
  // Of an exemplar of unknown size nothing is known.
  const Torus unknown(TexturedSurface{}, true);
  CHECK_FALSE(unknown.toroidal);
  CHECK(unknown.brought({-300.0f, 1e6f}) == Vec2f(-300.0f, 1e6f));
}

TEST_CASE("places: unwrapped, a place is less than half an exemplar from the other") {
  const Torus torus = torusOf(true);
  CHECK(torus.unwrapped({1.0f, 2.0f}, {62.0f, 47.0f}) == Vec2f(65.0f, 50.0f));
  CHECK(torus.unwrapped({62.0f, 47.0f}, {1.0f, 2.0f}) == Vec2f(-2.0f, -1.0f));
  CHECK(torus.unwrapped({10.0f, 20.0f}, {41.0f, 43.0f}) == Vec2f(10.0f, 20.0f));
  CHECK(torus.unwrapped({10.0f, 20.0f}, {43.0f, 45.0f}) == Vec2f(74.0f, 68.0f));
  CHECK(torus.unwrapped({10.0f, 20.0f}, {10.0f + 640.0f, 20.0f - 480.0f}) == Vec2f(650.0f, -460.0f));
  CHECK(torusOf(false).unwrapped({1.0f, 2.0f}, {62.0f, 47.0f}) == Vec2f(1.0f, 2.0f));
}

TEST_CASE("places: a piece goes on by its gradient") {
  const TexelGradient gradient{{10.0f, 2.0f, 0.0f}, {0.0f, -4.0f, 8.0f}};
  CHECK(continued({5.0f, 6.0f}, gradient, {0.0f, 0.0f, 0.0f}) == Vec2f(5.0f, 6.0f));
  CHECK(continued({5.0f, 6.0f}, gradient, {0.5f, 0.25f, 2.0f}) == Vec2f(10.5f, 21.0f));
}

TEST_CASE("places: of one piece is what continues the other within the mean of both ways") {
  const std::vector<Vec3f> positions{{0.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}};
  const TexelGradient right{{1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}};
  const auto asked = [&](const Torus& torus, const Vec2f& a, const Vec2f& b, const TexelGradient& atB) {
    const Places places{{a, b}, {right, atB}};
    const bool there = onePiece(torus, positions, places, 0, 1);
    CHECK(onePiece(torus, positions, places, 1, 0) == there);
    return there;
  };
  const Torus torus = torusOf(true), plain = torusOf(false);
  CHECK(asked(plain, {10, 10}, {11, 10}, right));
  CHECK(asked(plain, {10, 10}, {11.5f, 10.5f}, right));        // off by 0.71 both ways
  CHECK_FALSE(asked(plain, {10, 10}, {11.6f, 10.5f}, right));  // 0.78
  CHECK_FALSE(asked(plain, {10, 10}, {11, 10.75f}, right));    // the bound itself is not below it
  // One way exact, the other way off by as much as the gradients differ.
  const TexelGradient longer{{2.25f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}}, much{{2.75f, 0.0f, 0.0f}, {0, 1, 0}};
  CHECK(asked(plain, {10, 10}, {11, 10}, longer));
  CHECK_FALSE(asked(plain, {10, 10}, {11, 10}, much));
  // Across the edge.
  CHECK(asked(torus, {63, 10}, {0, 58}, right));
  CHECK_FALSE(asked(plain, {63, 10}, {0, 58}, right));
}
