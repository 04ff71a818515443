#include "texture/measure/pieces.h"

#include "tests/texture/measure/sheet.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex::testing;
using Catch::Matchers::WithinAbs;

TEST_CASE("measure: shape is the stretch of the coordinates", "[texture]") {
  const Image picture = cells(64);
  const auto shapeOf = [&](float a, float b, float c, float d) {
    const auto found = measurePieces(
        sheet(picture, [=](const Vec2f& l) { return Vec2f(a * l[0] + b * l[1], c * l[0] + d * l[1]); }),
        picture, true);
    REQUIRE(found);
    CHECK(found->joints == 0.0);
    CHECK(found->chips == 0.0);
    return found->shape;
  };
  CHECK_THAT(shapeOf(1, 0, 0, 1), WithinAbs(1.0, 1e-3));
  CHECK_THAT(shapeOf(0.6f, -0.8f, 0.8f, 0.6f), WithinAbs(1.0, 1e-3));
  CHECK_THAT(shapeOf(-1, 0, 0, 1), WithinAbs(1.0, 1e-3));    // mirrored
  CHECK_THAT(shapeOf(0.5f, 0, 0, 1), WithinAbs(2.0, 1e-3));  // drawn out to twice its length
  CHECK_THAT(shapeOf(1, 0, 0, 1.5f), WithinAbs(1.5, 1e-3));  // squeezed
  CHECK_THAT(shapeOf(1, 1, 0, 1), WithinAbs(0.5 + 0.5 * std::sqrt(5.0), 1e-3));  // sheared
}

TEST_CASE("measure: pieces are told apart, and small ones are chips", "[texture]") {
  const Image picture = cells(64);
  const auto of = [&](int size) {
    const auto found = measurePieces(sheet(picture, blocks(size, 64)), picture, true);
    REQUIRE(found);
    return *found;
  };
  const Pieces large = of(16), small = of(4);
  // 36 blocks of 16 on either side of the sheet, but for those its middle line cuts; joints along their
  // sides.
  CHECK(large.chips < 0.02);
  CHECK((large.pieces >= 60 && large.pieces <= 130));
  CHECK_THAT(large.joints, WithinAbs(2.0 * 2.0 / (3.0 * 16), 0.03));
  CHECK(large.seams > 1.0);
  CHECK(small.chips > 0.9);
  CHECK(measurePieces(sheet(picture, asItIs), picture, true)->pieces <= 4);
}

TEST_CASE("measure: a seam that does not show has the exemplar's own contrast", "[texture]") {
  // Every second column is the same: what jumps by two columns goes on as if nothing had been.
  const Image picture = paint(64, 64, [](float x, float, float* c) {
    c[0] = c[1] = c[2] = int(x) % 2 == 0 ? 0.2f : 0.6f;
    c[3] = 1.0f;
  });
  const auto halves = [](float jump) {
    return [=](const Vec2f& l) { return Vec2f(l[0] + (l[0] < 48.0f ? 0.0f : jump), l[1]); };
  };
  const auto hidden = measurePieces(sheet(picture, halves(20.0f)), picture, true);
  const auto shown = measurePieces(sheet(picture, halves(21.0f)), picture, true);
  REQUIRE((hidden && shown));
  CHECK(hidden->joints > 0.0);
  // Of the edges across, half are a texel long and half a diagonal; side by side means columns and rows
  // alike.
  CHECK_THAT(hidden->seams, WithinAbs(std::sqrt(4.0 / 3.0), 0.02));
  CHECK(shown->seams < 0.02);  // columns that should differ are alike
}
