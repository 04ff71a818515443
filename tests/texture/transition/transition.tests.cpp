#include "texture/transition/transition.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>
#include <stdexcept>

using namespace fluidtex::texture;

namespace {

Image picture(int width, int height, const std::function<Vec3f(int, int)>& color) {
  Image image{width, height, 4, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Vec3f c = color(x, y);
      image.data.insert(image.data.end(), {c[0], c[1], c[2], 1.0f});
    }
  return image;
}

// Discs of a colour on white, in rows.
Image discs(int width, int height, const Vec3f& color, int pitch, int radius) {
  return picture(width, height, [&](int x, int y) {
    const int row = y / pitch, dx = (x + (row % 2) * pitch / 2) % pitch - pitch / 2,
              dy = y % pitch - pitch / 2;
    return dx * dx + dy * dy <= radius * radius ? color : Vec3f(1.0f);
  });
}

const float* shown(const Image& left, const Image& right, int width, int x, int y, bool fromRight) {
  return fromRight ? right.at(x, y) : left.at(left.width - width + x, y);
}

// Sum over neighbours in rows of the jump that the transition adds to those of its pictures.
double visibleSeams(const Image& left, const Image& right, const std::vector<std::uint8_t>& fromRight,
                    int width) {
  double sum = 0.0;
  for (int y = 0; y < left.height; ++y)
    for (int x = 1; x < width; ++x) {
      const bool here = fromRight[std::size_t(y * width + x)],
                 before = fromRight[std::size_t(y * width + x - 1)];
      const float* expected = shown(left, right, width, x - 1, y, here);
      const float* found = shown(left, right, width, x - 1, y, before);
      for (int c = 0; c < 3; ++c) sum += std::abs(expected[c] - found[c]);
    }
  return sum;
}

}  // namespace

TEST_CASE("transition: begins as the one picture and ends as the other, the same each time") {
  const Image left = discs(200, 160, Vec3f(0.1f, 0.2f, 0.8f), 20, 7);
  const Image right = discs(180, 160, Vec3f(0.9f, 0.1f, 0.1f), 26, 9);
  const TransitionOptions options{.width = 120, .feature = 20, .seed = 3};
  const std::vector<std::uint8_t> fromRight = transition(left, right, options);
  REQUIRE(fromRight.size() == 120u * 160u);
  for (int y = 0; y < 160; ++y) {
    REQUIRE(!fromRight[std::size_t(y * 120)]);
    REQUIRE(fromRight[std::size_t(y * 120 + 119)]);
  }
  CHECK(fromRight == transition(left, right, options));
}

TEST_CASE("transition: the share of the other rises evenly, as a mean over seeds") {
  const Image left = discs(200, 160, Vec3f(0.1f, 0.2f, 0.8f), 20, 7);
  const Image right = discs(180, 160, Vec3f(0.9f, 0.1f, 0.1f), 26, 9);
  std::vector<double> share(4, 0.0);
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const auto fromRight = transition(left, right, {.width = 120, .feature = 20, .seed = seed});
    for (std::size_t i = 0; i < fromRight.size(); ++i)
      share[i % 120 / 30] += fromRight[i] / (6.0 * 30.0 * 160.0);
  }
  INFO(share[0] << " " << share[1] << " " << share[2] << " " << share[3]);
  for (std::size_t k = 0; k < 4; ++k) CHECK(share[k] == Approx(0.125 + 0.25 * double(k)).margin(0.06));
}

TEST_CASE("transition: outlines run between features, not through them") {
  const Image left = discs(240, 200, Vec3f(0.1f, 0.2f, 0.8f), 20, 6);
  const Image right = discs(240, 200, Vec3f(0.8f, 0.2f, 0.1f), 20, 6);
  const int width = 160;
  const std::vector<std::uint8_t> fromRight =
      transition(left, right, {.width = width, .feature = 20, .seed = 1});
  // A straight cut where both have equal shares, for comparison.
  std::vector<std::uint8_t> straight;
  for (int i = 0; i < 200 * width; ++i) straight.push_back(i % width >= width / 2);
  int outline = 0;
  for (std::size_t i = 1; i < fromRight.size(); ++i)
    outline += int(i) % width > 0 && fromRight[i] != fromRight[i - 1];
  const double found = visibleSeams(left, right, fromRight, width),
               plain = visibleSeams(left, right, straight, width);
  INFO(found << " of visible seam on " << outline << " rows crossed, " << plain << " on 200");
  CHECK(outline > 400);  // pieces, not one cut
  CHECK(found / outline < 0.25 * plain / 200.0);
}

TEST_CASE("transition: where both pictures are the same nothing is seen of it") {
  const auto color = [](int x, int y) { return Vec3f(0.5f + 0.4f * float(std::sin(0.3 * x + 0.1 * y))); };
  const Image left = picture(100, 60, color);
  const Image right = picture(100, 60, [&](int x, int y) { return color(x + 40, y); });
  const auto fromRight = transition(left, right, {.width = 60, .feature = 12, .seed = 1});
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 60; ++x)
      REQUIRE(shown(left, right, 60, x, y, fromRight[std::size_t(y * 60 + x)])[0] ==
              Approx(color(40 + x, y)[0]).margin(0.02));
}

TEST_CASE("transition: what it cannot take it refuses") {
  const Image left = discs(60, 40, Vec3f(0.0f), 20, 5), low = discs(60, 39, Vec3f(0.0f), 20, 5);
  CHECK_THROWS_AS(transition(left, low, {.width = 20}), std::invalid_argument);
  CHECK_THROWS_AS(transition(left, left, {.width = 61}), std::invalid_argument);
  CHECK_THROWS_AS(transition(left, left, {.width = 7}), std::invalid_argument);
  CHECK_THROWS_AS(transition(left, left, {.width = 20, .feature = 1}), std::invalid_argument);
  CHECK_THROWS_AS(transition(left, Image{60, 40, 1, std::vector<float>(2400)}, {.width = 20}),
                  std::invalid_argument);
}
