#include "texture/exemplar/channels.h"

#include "tests/texture/exemplar/sample_images.h"

#include <catch2/catch.hpp>

#include <functional>
#include <numeric>

using namespace fluidtex::texture;
using namespace fluidtex::testing;
using Catch::Matchers::WithinAbs;
using fluidtex::randomUnit;

namespace {

Image grey(int width, int height, const std::function<float(int, int)>& value) {
  Image image{width, height, 1, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) image.data.push_back(value(x, y));
  return image;
}

Image shifted(const Image& image, int dx, int dy) {
  return grey(image.width, image.height,
              [&](int x, int y) { return *image.at((x + dx) % image.width, (y + dy) % image.height); });
}

double sum(const Image& image) {
  return std::accumulate(image.data.begin(), image.data.end(), 0.0);
}

// A bright or dark bar of six columns, 30 to 35.
Image bar(float background, float value) {
  return grey(64, 48, [=](int x, int) { return x >= 30 && x < 36 ? value : background; });
}

}  // namespace

TEST_CASE("blur: the response to a point is a Gaussian of unit sum and variance sigma^2", "[texture]") {
  for (const double sigma : {1.0, 3.0}) {
    const Image point = grey(65, 65, [](int x, int y) { return x == 32 && y == 32 ? 1.0f : 0.0f; });
    const Image blurred = blur(point, false, sigma);
    double variance = 0.0;
    for (int y = 0; y < 65; ++y)
      for (int x = 0; x < 65; ++x) variance += double(*blurred.at(x, y)) * (x - 32) * (x - 32);
    CHECK_THAT(sum(blurred), WithinAbs(1.0, 1e-5));
    // The kernel ends at three sigma, which costs three per cent of the variance.
    CHECK_THAT(variance, WithinAbs(sigma * sigma, 0.04 * sigma * sigma));
  }
}

TEST_CASE("blur: constants stay, and a toroidal image keeps its sum and moves with its content",
          "[texture]") {
  const Image flat = grey(40, 30, [](int, int) { return 0.7f; });
  for (const bool toroidal : {false, true})
    CHECK(largestDifference(blur(flat, toroidal, 10.0).data, flat.data) < 1e-5f);
  const Image noise =
      grey(40, 30, [](int x, int y) { return float(randomUnit(1, std::uint64_t(x + 40 * y))); });
  CHECK_THAT(sum(blur(noise, true, 10.0)), WithinAbs(sum(noise), 1e-2));
  CHECK(largestDifference(blur(shifted(noise, 7, 11), true, 10.0).data,
                          shifted(blur(noise, true, 10.0), 7, 11).data) < 1e-5f);
}

TEST_CASE("halve: the mean stays, odd sizes are rounded up, linear images stay linear", "[texture]") {
  const Image noise =
      grey(40, 30, [](int x, int y) { return float(randomUnit(2, std::uint64_t(x + 40 * y))); });
  const Image smaller = halve(noise, false);
  CHECK(smaller.width == 20);
  CHECK(smaller.height == 15);
  CHECK_THAT(4.0 * sum(smaller), WithinAbs(sum(noise), 1e-3));

  const Image ramp = grey(9, 7, [](int x, int y) { return float(x + 10 * y); });
  const Image small = halve(ramp, false);
  REQUIRE(small.width == 5);
  REQUIRE(small.height == 4);
  // Texel x of the half lies at 2 x + 1/2.
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 4; ++x) CHECK(*small.at(x, y) == (2 * x + 0.5f) + 10 * (2 * y + 0.5f));
  CHECK(*small.at(4, 0) == 8 + 5.0f);              // the last column with itself
  CHECK(*halve(ramp, true).at(4, 0) == 4 + 5.0f);  // with the first
}

TEST_CASE("feature luminance: grey of opaque colours, half alpha where there is alpha", "[texture]") {
  const Image opaque{1, 1, 3, {0.6f, 0.6f, 0.6f}}, veil{1, 1, 4, {0.3f, 0.3f, 0.3f, 0.5f}};
  CHECK_THAT(featureLuminance(opaque).data[0], WithinAbs(0.6, 1e-6));
  CHECK_THAT(featureLuminance(veil).data[0], WithinAbs(0.4, 1e-6));
}

TEST_CASE("feature distance: a thin bar gives the signed distance from it, bright or dark", "[texture]") {
  const Image bright = featureDistance(bar(0.3f, 0.8f), false),
              dark = featureDistance(bar(0.8f, 0.3f), false);
  CHECK(largestDifference(bright.data, dark.data) < 1e-5f);
  // From the bar outwards the distance grows by one pixel a pixel, of the twelve that 0..1 stands for.
  const auto pixels = [&](int x) { return 12.0f * *bright.at(x, 20) - 4.0f; };
  CHECK_THAT(pixels(33) - pixels(32), WithinAbs(0.0, 1e-4));
  CHECK(pixels(32) < -1.0f);
  for (int x = 36; x < 42; ++x) CHECK_THAT(pixels(x) - pixels(x - 1), WithinAbs(1.0, 1e-4));
  // Its outline is the bar's.
  CHECK_THAT(pixels(36), WithinAbs(0.5, 1e-4));
  CHECK_THAT(pixels(35), WithinAbs(-0.5, 1e-4));
  CHECK_THAT(*bright.at(50, 20), WithinAbs(1.0, 1e-6));
  for (const float value : bright.data) CHECK((value >= 0.0f && value <= 1.0f));
}

TEST_CASE("feature distance: around a disc it grows with the radius, alike in all directions", "[texture]") {
  const Image disc = grey(80, 80, [](int x, int y) {
    return std::hypot(float(x) - 40.0f, float(y) - 40.0f) < 6.0f ? 1.0f : 0.0f;
  });
  const Image distance = featureDistance(disc, false);
  float least = 100.0f, most = -100.0f;
  for (float angle = 0.0f; angle < 6.3f; angle += 0.02f)
    for (const float radius : {9.0f, 10.0f, 11.0f, 12.0f}) {
      const int x = int(std::lround(40.0f + radius * std::cos(angle)));
      const int y = int(std::lround(40.0f + radius * std::sin(angle)));
      const float outline =
          std::hypot(float(x) - 40.0f, float(y) - 40.0f) - (12.0f * *distance.at(x, y) - 4.0f);
      least = std::min(least, outline), most = std::max(most, outline);
    }
  // The outline is made of pixels; the blur widens a small disc by up to one.
  CHECK(most - least < 1.0f);
  CHECK(least > 5.5f);
  CHECK(most < 7.8f);
}

TEST_CASE("feature distance: specks and plain images have no features", "[texture]") {
  const Image speck = grey(64, 64, [](int x, int y) { return x / 3 == 10 && y / 3 == 10 ? 1.0f : 0.0f; });
  const Image flat = grey(64, 64, [](int x, int) { return 0.5f + 1e-4f * float(x % 2); });
  for (const float value : featureDistance(speck, false).data) CHECK(value == 1.0f);
  for (const float value : featureDistance(flat, false).data) CHECK(value == 1.0f);
}

TEST_CASE("feature channels: a toroidal image's move with its content", "[texture]") {
  const Image texture = grey(64, 64, [](int x, int y) { return smoothNoise(float(x), float(y), 64, 8, 3); });
  const Image moved = shifted(texture, 29, 13);
  CHECK(largestDifference(featureDistance(moved, true).data,
                          shifted(featureDistance(texture, true), 29, 13).data) < 1e-4f);
  CHECK(largestDifference(gradientEnergy(moved, true).data,
                          shifted(gradientEnergy(texture, true), 29, 13).data) < 1e-4f);
}

TEST_CASE("gradient energy: even on a slope, zero on a plain, independent of contrast, capped", "[texture]") {
  const Image slope = grey(50, 40, [](int x, int y) { return 0.01f * float(x) + 0.005f * float(y); });
  for (const float value : gradientEnergy(slope, false).data) CHECK_THAT(value, WithinAbs(1.0, 1e-3));
  for (const float value : gradientEnergy(grey(50, 40, [](int, int) { return 0.4f; }), false).data)
    CHECK(value == 0.0f);

  const Image texture = grey(64, 64, [](int x, int y) { return smoothNoise(float(x), float(y), 64, 8, 4); });
  const Image faint = grey(64, 64, [&](int x, int y) { return 0.2f * *texture.at(x, y) + 0.3f; });
  CHECK(largestDifference(gradientEnergy(texture, true).data, gradientEnergy(faint, true).data) < 1e-4f);

  const Image edge =
      grey(200, 200, [](int x, int y) { return x == 100 && y < 10 ? 1.0f : 0.001f * float(x); });
  const Image energy = gradientEnergy(edge, false);
  CHECK(*std::max_element(energy.data.begin(), energy.data.end()) <= 1.2f);
}
