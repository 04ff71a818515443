#include "texture/shown/shown_color.h"

#include "numerics/random.h"
#include "texture/exemplar/srgb.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex::texture;
using fluidtex::randomUnit;

namespace {

// Opaque grey noise about 0.5.
Image noise(int side) {
  Image image{side, side, 4, {}};
  for (int i = 0; i < side * side; ++i) {
    const float grey = 0.25f + 0.5f * float(randomUnit(7, std::uint64_t(i)));
    image.data.insert(image.data.end(), {grey, grey, grey, 1.0f});
  }
  return image;
}

}  // namespace

TEST_CASE("shown color: half-way between two places there is as much contrast as at either") {
  const Image color = noise(128), around = lightnessAround(color, true);
  const auto contrast = [&](float weight) {
    double sum = 0.0, squares = 0.0;
    const int count = 4000;
    for (int i = 0; i < count; ++i) {
      const auto place = [&](std::uint64_t salt) {
        return Vec2f(float(int(128.0 * randomUnit(salt, std::uint64_t(2 * i)))),
                     float(int(128.0 * randomUnit(salt, std::uint64_t(2 * i + 1)))));
      };
      const double grey = shownColor(color, around, true, place(1), place(2), weight)[0];
      sum += grey / count, squares += grey * grey / count;
    }
    return std::sqrt(squares - sum * sum);
  };
  const double alone = contrast(0.0f);
  CHECK(contrast(1.0f) == Approx(alone).epsilon(0.05));
  // A plain mean would have 0.71 of it. What lies on one side of the mean at both places does not overshoot.
  CHECK(contrast(0.5f) > 0.85 * alone);
  CHECK(contrast(0.5f) < 1.05 * alone);
}

TEST_CASE("shown color: a bright place comes evenly to the eye, however dark it was before") {
  Image color{64, 32, 4, {}};
  for (int i = 0; i < 64 * 32; ++i) {
    const float grey = i % 64 < 32 ? 0.01f : 0.9f;
    color.data.insert(color.data.end(), {grey, grey, grey, 1.0f});
  }
  const Image around = lightnessAround(color, false);
  float last = encodeSrgb(0.01f);
  for (int step = 1; step <= 10; ++step) {
    const Vec4f shown = shownColor(color, around, false, {48, 16}, {16, 16}, 1.0f - 0.1f * float(step));
    const float now = encodeSrgb(shown[0]);
    CHECK(now - last > 0.01f);
    CHECK(now - last < 0.16f);  // of 0.86; a tenth of the light would be 0.25
    last = now;
  }
}

TEST_CASE("shown color: the ends are the places themselves, and the same place stays as it is") {
  const Image color = noise(32), around = lightnessAround(color, false);
  const Vec2f a(7.25f, 11.5f), b(20.0f, 3.75f);
  float expected[4];
  sampleCubic(color, false, a, expected);
  CHECK((shownColor(color, around, false, a, b, 0.0f) - Vec4f(expected)).length() < 1e-6f);
  CHECK((shownColor(color, around, false, b, a, 1.0f) - Vec4f(expected)).length() < 1e-5f);
  CHECK((shownColor(color, around, false, a, a, 0.3f) - Vec4f(expected)).length() < 1e-5f);
}

TEST_CASE("shown color: what colour a transparent texel has is never seen, still or fading") {
  Image cut = noise(64), other = cut;
  for (std::size_t i = 0; i < cut.data.size(); i += 4) {
    const bool hole = randomUnit(5, i / 16) < 0.5;
    cut.data[i + 3] = other.data[i + 3] = hole ? 0.0f : 1.0f;
    if (!hole) continue;
    for (std::size_t c = 0; c < 3; ++c) cut.data[i + c] = 0.0f, other.data[i + c] = float(c) * 7.0f;
  }
  const Image aroundCut = lightnessAround(cut, true), aroundOther = lightnessAround(other, true);
  double seenThrough = 0.0;
  for (std::uint64_t i = 0; i < 500; ++i) {
    const Vec2f a(64.0f * float(randomUnit(1, i)), 64.0f * float(randomUnit(2, i)));
    const Vec2f b(64.0f * float(randomUnit(3, i)), 64.0f * float(randomUnit(4, i)));
    for (const float weight : {0.0f, 0.3f, 1.0f}) {
      const Vec4f one = shownColor(cut, aroundCut, true, a, b, weight);
      const Vec4f two = shownColor(other, aroundOther, true, a, b, weight);
      CHECK((one - two).length() < 1e-5f);
      // Between texels of 0.25 to 0.75 nothing is darker, however near the hole: that would be a dark rim.
      if (weight == 0.0f && one[3] > 0.2f) CHECK(one[0] > 0.1f);
      seenThrough += one[3] < 0.5f;
    }
  }
  CHECK(seenThrough > 300.0);
}
