#include "texture/shown/sequence.h"

#include "tests/texture/exemplar/test_images.h"
#include "tests/texture/shown/two_vertices.h"
#include "texture/shown/maps.h"

#include <catch2/catch.hpp>

using namespace fluidtex::texture;
using namespace fluidtex::testing;

namespace {

void checkSame(const Vec4f& a, const Vec4f& b) {
  for (int c = 0; c < 4; ++c) CHECK(a[c] == Approx(b[c]).margin(1e-6));
}

}  // namespace

TEST_CASE("sequence: time walks through the pictures, over and over or once", "[texture]") {
  AnimationOptions animation{.rate = 12.0};
  const auto at = [&](double seconds) { return picturesAt(animation, 4, seconds); };
  CHECK(at(0.0).first == 0);
  CHECK(at(0.0).share == 0.0f);
  CHECK(at(1.5 / 12).first == 1);
  CHECK(at(1.5 / 12).second == 2);
  CHECK(at(1.5 / 12).share == Approx(0.5));
  // Round the end, and a frame's time that is off by rounding.
  CHECK(at(3.25 / 12).first == 3);
  CHECK(at(3.25 / 12).second == 0);
  CHECK(at(3.25 / 12).share == Approx(0.25));
  CHECK(at((4.0 - 1e-9) / 12).first == 0);
  CHECK(at((4.0 - 1e-9) / 12).share == 0.0f);
  CHECK(at(401.0 / 12).first == 1);
  animation.loop = false;
  CHECK(at(2.5 / 12).second == 3);
  for (const double late : {3.0, 3.25, 400.0}) {
    CHECK(at(late / 12).first == 3);
    CHECK(at(late / 12).second == 3);
    CHECK(at(late / 12).share == 0.0f);
  }
}

TEST_CASE("sequence: a level of guidance lies between two pictures", "[texture]") {
  CHECK(picturesFor(5, 0.0f).first == 0);
  CHECK(picturesFor(5, 0.375f).first == 1);
  CHECK(picturesFor(5, 0.375f).second == 2);
  CHECK(picturesFor(5, 0.375f).share == Approx(0.5));
  CHECK(picturesFor(5, 1.0f).first == 4);
  CHECK(picturesFor(5, 1.0f).second == 4);
  CHECK(picturesFor(5, 7.0f).first == 4);
  CHECK(picturesFor(5, -1.0f).first == 0);
  CHECK(picturesFor(1, 0.5f).second == 0);
}

TEST_CASE("sequence: pictures are mixed as light, by alpha", "[texture]") {
  const Image red = imageOf(2, 1, 4, [](int, int, int c) { return c == 0 || c == 3 ? 1.0f : 0.0f; });
  const Image glass = imageOf(2, 1, 4, [](int, int, int c) { return c == 2 ? 1.0f : 0.0f; });
  const Image half = mixed(red, glass, 0.5f);
  checkSame(Vec4f(half.at(1, 0)), Vec4f(1.0f, 0.0f, 0.0f, 0.5f));  // what does not show has no colour
  CHECK(mixed(red, glass, 0.0f).data == red.data);
  CHECK_THROWS_AS(mixed(red, noiseImage(3, 1, 4, 1), 0.5f), std::invalid_argument);
  CHECK_THROWS_AS(mixed(noiseImage(2, 1, 3, 1), noiseImage(2, 1, 3, 2), 0.5f), std::invalid_argument);
}

TEST_CASE("sequence: each vertex shows its own pictures, with what fades", "[texture]") {
  std::vector<Image> pictures;
  for (const std::uint64_t seed : {1, 2, 3}) pictures.push_back(blobImage(8, 4, 4, 4.0, seed));
  TexturedSurface alone[3];
  for (std::size_t n = 0; n < 3; ++n) {
    alone[n] = twoVertices();
    lookUpColor(pictures[n], true, alone[n]);
  }
  TexturedSurface surface = twoVertices();
  lookUpColors(pictures, {{0, 1, 0.0f}, {1, 2, 0.0f}}, true, surface);
  checkSame(surface.color[0], alone[0].color[0]);
  checkSame(surface.color[1], alone[1].color[1]);
  lookUpColors(pictures, {{1, 2, 0.5f}, {2, 0, 0.25f}}, true, surface);
  checkSame(surface.color[0], 0.5f * (alone[1].color[0] + alone[2].color[0]));
  checkSame(surface.color[1], 0.75f * alone[2].color[1] + 0.25f * alone[0].color[1]);
}

TEST_CASE("sequence: pictures that are not there, or differ in size, are refused", "[texture]") {
  const std::vector<Image> pictures{blobImage(8, 8, 4, 6.0, 1), blobImage(8, 4, 4, 6.0, 2)};
  TexturedSurface surface = twoVertices();
  const ShownPictures first{0, 0, 0.0f};
  CHECK_THROWS_AS(lookUpColors(pictures, {first, first}, true, surface), std::invalid_argument);
  CHECK_THROWS_AS(lookUpColors({pictures[0]}, {first}, true, surface), std::invalid_argument);
  CHECK_THROWS_AS(lookUpColors({pictures[0]}, {first, {0, 1, 0.5f}}, true, surface), std::invalid_argument);
}
