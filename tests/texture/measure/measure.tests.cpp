// The figures of a texture, on surfaces where they are known.
#include "texture/measure/measure.h"

#include "tests/texture/measure/sheet.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex::testing;
using Catch::Matchers::WithinAbs;

namespace {

Image blurred(const Image& image) {
  Image result = image;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < 3; ++c) {
        float sum = 0.0f;
        for (int i = -1; i <= 1; ++i)
          for (int j = -1; j <= 1; ++j)
            sum += image.at((x + i + image.width) % image.width, (y + j + image.height) % image.height)[c];
        result.at(x, y)[c] = sum / 9.0f;
      }
  return result;
}

}  // namespace

TEST_CASE("measure: the exemplar itself is like itself, as sharp and all in use", "[texture][slow]") {
  const Image picture = cells(144);
  LikenessJudge judge(picture);
  const auto itself = judge(sheet(picture, turned));
  REQUIRE(itself);
  CHECK(itself->tile == 47);
  CHECK(itself->likeness < 1.0);
  // 1.06 to 1.18 on such pictures of 112 to 176 pixels: tiles that are laid by chance blur a little more.
  CHECK_THAT(itself->sharpness, WithinAbs(1.0, 0.2));
  CHECK(itself->coverage > 0.7);

  const auto soft = judge(sheet(blurred(picture), turned));
  REQUIRE(soft);
  CHECK(soft->sharpness < 0.7 * itself->sharpness);
  CHECK(itself->spectrum < 1.5);
  CHECK(soft->spectrum > 2.0 * itself->spectrum);
  CHECK(soft->likeness > 1.1 * itself->likeness);
  const auto other = judge(sheet(stripes(144), turned));
  REQUIRE(other);
  CHECK(other->likeness > 3.0 * itself->likeness);
  const auto part = judge(sheet(picture, [](const Vec2f& l) {
    return Vec2f(l[0] - 24.0f * std::floor(l[0] / 24.0f), l[1] - 24.0f * std::floor(l[1] / 24.0f));
  }));
  REQUIRE(part);
  CHECK(part->coverage < 0.6 * itself->coverage);
}

TEST_CASE("measure: a frame's figures do not depend on the frames that were judged before", "[texture]") {
  const Image picture = cells(96);
  const MeasureOptions few{.tile = 31, .tiles = 24, .patches = 200};
  const TexturedSurface first = sheet(picture, asItIs), second = sheet(blurred(picture), turned);
  LikenessJudge series(picture, few);
  series(first, true);
  series(first);
  const auto third = series(second, true), alone = LikenessJudge(picture, few)(second, true);
  REQUIRE((third && alone));
  CHECK(third->likeness == alone->likeness);
  CHECK(third->sharpness == alone->sharpness);
  CHECK(third->coverage == alone->coverage);
  CHECK(third->repeats == alone->repeats);
  CHECK(third->tiles == alone->tiles);
  // And whether repeats are asked for as well.
  CHECK(series(second)->likeness == alone->likeness);
}

TEST_CASE("measure: a surface that nowhere is flat has no likeness", "[texture]") {
  const Image picture = stripes(64);
  LikenessJudge judge(picture);
  TexturedSurface ball = sheet(picture, asItIs);
  const SurfaceMesh mesh = sphereMesh(3);
  ball.positions = ball.normals = mesh.positions;
  ball.triangles = mesh.triangles;
  ball.spacing = mesh.spacing;
  ball.color.resize(mesh.positions.size());
  CHECK_FALSE(judge(ball));
  CHECK_FALSE(judge({}));
}

TEST_CASE("measure: what is shown twice repeats", "[texture][slow]") {
  const Image picture = cells(192);  // both sides of the sheet have parts of their own
  LikenessJudge judge(picture);
  const auto once = judge(sheet(picture, asItIs), true);
  const auto tiled = judge(sheet(picture,
                                 [](const Vec2f& l) {
                                   return Vec2f(l[0] - 32.0f * std::floor(l[0] / 32.0f),
                                                l[1] - 32.0f * std::floor(l[1] / 32.0f));
                                 }),
                           true);
  REQUIRE((once && tiled));
  CHECK_THAT(*once->repeats, WithinAbs(0.0, 0.15));
  CHECK(*tiled->repeats > *once->repeats + 0.3);
}
