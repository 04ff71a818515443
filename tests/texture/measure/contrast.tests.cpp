#include "texture/measure/contrast.h"

#include "tests/texture/measure/sheet.h"
#include "texture/exemplar/srgb.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace fluidtex::testing;
using Catch::Matchers::WithinAbs;

TEST_CASE("measure: contrast is that of the texels that were chosen", "[texture]") {
  // Plain on the left, squares on the right.
  const Image picture = paint(128, 64, [](float x, float y, float* c) {
    c[0] = c[1] = c[2] = x < 64 ? 0.2f : float((int(x) / 4 + int(y) / 4) % 2);
    c[3] = 1.0f;
  });
  const Image contrast = contrastOf(picture);
  const auto shown = [&](float from, float width) {
    TexturedSurface surface = sheet(picture, asItIs);
    for (std::size_t v = 0; v < surface.coordinate.size(); ++v)
      surface.coordinate[v] = {from + float(v * 37 % 4096) / 4096.0f * width, float(v * 13 % 64)};
    return *measureContrast(surface, contrast);
  };
  CHECK_THAT(shown(0.0f, 127.0f), WithinAbs(1.0, 0.05));
  CHECK_THAT(shown(68.0f, 58.0f), WithinAbs(2.0, 0.1));
  CHECK(shown(2.0f, 58.0f) == 0.0);
  CHECK_FALSE(measureContrast(TexturedSurface{}, contrast));
  const Image plain = paint(16, 16, [](float, float, float* c) { c[0] = c[1] = c[2] = 0.3f, c[3] = 1.0f; });
  for (const float c : contrastOf(plain).data) CHECK(c == 1.0f);
}

TEST_CASE("contrast: of a ramp, in a closed form", "[texture]") {
  // As it is seen, luminance rises by the same from column to column, or from row to row. At either end the
  // slope is half of it.
  const bool down = GENERATE(false, true);
  const int width = down ? 9 : 20, height = down ? 20 : 9;
  const Image ramp = paint(width, height, [&](float x, float y, float* c) {
    c[0] = c[1] = c[2] = decodeSrgb(0.1f + 0.04f * (down ? y : x));
    c[3] = 1.0f;
  });
  const Image contrast = contrastOf(ramp);
  REQUIRE((contrast.width == width && contrast.height == height && contrast.channels == 1));
  REQUIRE(contrast.data.size() == 180);
  const double inner = 20.0 / 18.5;  // 18 steps of 1, 2 of 1/4
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int at = down ? y : x, in = std::min(at, 19 - at);
      CHECK_THAT(*contrast.at(x, y), WithinAbs(inner * (in == 0 ? 0.5 : in == 1 ? 0.75 : 1.0), 1e-4));
    }
}

TEST_CASE("contrast: what cannot be seen has none", "[texture]") {
  // Chequered, but see-through on the right.
  const Image picture = paint(40, 20, [](float x, float y, float* c) {
    c[0] = c[1] = c[2] = float((int(x) / 2 + int(y) / 2) % 2);
    c[3] = x < 20.0f ? 1.0f : 0.0f;
  });
  const Image contrast = contrastOf(picture);
  for (int y = 0; y < 20; ++y)
    for (int x = 22; x < 40; ++x) CHECK(*contrast.at(x, y) == 0.0f);
  CHECK(*contrast.at(10, 10) > 1.0f);
}

TEST_CASE("contrast: the mean over the nearest texels, whatever the trust", "[texture]") {
  const Image contrast{3, 2, 1, {1, 2, 4, 8, 16, 32}};
  TexturedSurface surface;
  surface.coordinate = {{0.4f, 0.4f}, {1.6f, 0.2f}, {0.6f, 0.7f}, {-7.0f, 1.0f}, {9.0f, 9.0f}, {1.0f, -3.0f}};
  surface.positions.resize(surface.coordinate.size());
  surface.trust.assign(surface.coordinate.size(), 0.0f);
  CHECK(*measureContrast(surface, contrast) == (1 + 4 + 16 + 8 + 32 + 2) / 6.0);
}
