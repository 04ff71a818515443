#include "texture/shown/color_between.h"

#include "tests/texture/exemplar/test_images.h"
#include "texture/shown/shown_color.h"

#include <catch2/catch.hpp>

using namespace fluidtex::texture;
using namespace fluidtex::testing;

namespace {

// One triangle on an exemplar of 16 x 12 texels.
TexturedSurface oneTriangle() {
  TexturedSurface surface;
  surface.exemplarWidth = 16;
  surface.exemplarHeight = 12;
  surface.positions = {{0.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}};
  surface.gradient.assign(3, {{1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}});
  surface.triangles = {{0, 1, 2}};
  surface.coordinate = {{4.0f, 5.0f}, {5.0f, 5.0f}, {4.0f, 6.0f}};
  surface.fading = noFading(3);
  return surface;
}

// A picture of 16 scale x 12 scale pixels, linear over it.
Image ramp(int scale) {
  return imageOf(16 * scale, 12 * scale, 4, [&](int x, int y, int c) {
    if (c == 3) return 1.0f;
    return c == 0 ? (float(x) + 0.5f) / float(16 * scale) : (float(y) + 0.5f) / float(12 * scale);
  });
}

const Vec3f kMiddle(0.5f, 0.25f, 0.25f);

std::optional<Vec4f> colorAt(const Detail& detail, const TexturedSurface& surface, const Vec3f& weights) {
  return colorBetween(detail, surface, findJoints(surface, detail.toroidal), 0, weights);
}

void checkIs(const std::optional<Vec4f>& color, const Vec4f& wanted) {
  REQUIRE(color);
  for (int c = 0; c < 4; ++c) CHECK((*color)[c] == Approx(wanted[c]).margin(1e-5));
}

}  // namespace

TEST_CASE("color between: the picture in any resolution at the place between the corners") {
  const int scale = GENERATE(1, 2, 5);
  const Detail detail = makeDetail(ramp(scale), false, 16);
  const TexturedSurface surface = oneTriangle();
  checkIs(colorAt(detail, surface, kMiddle),
          {(4.25f + 0.5f) / 16.0f, (5.25f + 0.5f) / 12.0f, (5.25f + 0.5f) / 12.0f, 1.0f});
  checkIs(colorAt(detail, surface, {0.0f, 1.0f, 0.0f}), {5.5f / 16.0f, 5.5f / 12.0f, 5.5f / 12.0f, 1.0f});
}

TEST_CASE(
    "color between: across a joint the pictures of its pieces, each gone on by its gradient, are mixed") {
  const Image picture = blobImage(16, 12, 4, 6.0, 5);
  const Detail detail = makeDetail(picture, false, 16);
  TexturedSurface surface = oneTriangle();
  // The third corner's piece is turned by a quarter.
  surface.coordinate[2] = {10.0f, 8.0f};
  surface.gradient[2] = {{0.0f, 1.0f, 0.0f}, {-1.0f, 0.0f, 0.0f}};
  const auto at = [&](float x, float y) { return samplePremultiplied(picture, false, {x, y}); };
  // At (0.25, 0.25): the first two agree on (4.25, 5.25); the third is at (0.25, -0.75) from its corner.
  checkIs(colorAt(detail, surface, kMiddle),
          at(4.25f, 5.25f) * 0.75f + at(10.0f - 0.75f, 8.0f - 0.25f) * 0.25f);
  checkIs(colorAt(detail, surface, {0.0f, 0.0f, 1.0f}), at(10.0f, 8.0f));
  checkIs(colorAt(detail, surface, {0.5f, 0.5f, 0.0f}), at(4.5f, 5.0f));
}

TEST_CASE("color between: nothing without coordinates") {
  const Detail detail = makeDetail(ramp(1), false, 16);
  TexturedSurface surface = oneTriangle();
  surface.coordinate.clear();
  CHECK_FALSE(colorAt(detail, surface, kMiddle));
  CHECK_THROWS_AS(makeDetail(noiseImage(8, 8, 3, 1), false, 8), std::invalid_argument);
  CHECK_THROWS_AS(makeDetail({}, false, 8), std::invalid_argument);
}

TEST_CASE("color between: a piece goes on over the edge of a toroidal picture") {
  TexturedSurface surface = oneTriangle();
  surface.coordinate = {{15.5f, 11.5f}, {0.5f, 11.5f}, {15.5f, 0.5f}};
  const Image picture = imageOf(16, 12, 4, [](int x, int y, int c) {
    return c == 3 ? 1.0f : x == 0 || x == 15 || y == 0 || y == 11 ? 0.8f : 0.1f;
  });
  checkIs(colorAt(makeDetail(picture, true, 16), surface, kMiddle), {0.8f, 0.8f, 0.8f, 1.0f});
}

TEST_CASE("color between: what fades is mixed as at vertices") {
  const Image picture = blobImage(16, 12, 4, 6.0, 3);
  const Detail detail = makeDetail(picture, false, 16);
  TexturedSurface surface = oneTriangle();
  surface.fading.coordinate = {{10.0f, 3.0f}, {11.0f, 3.0f}, {10.0f, 4.0f}};
  surface.fading.weight = {0.5f, 0.25f, 0.75f};
  surface.fading.gradient = surface.gradient;
  for (int k = 0; k < 3; ++k) {
    Vec3f corner(0.0f);
    corner[k] = 1.0f;
    checkIs(colorAt(detail, surface, corner),
            shownColor(picture, lightnessAround(picture, false), false, surface.coordinate[std::size_t(k)],
                       surface.fading.coordinate[std::size_t(k)], surface.fading.weight[std::size_t(k)]));
  }
  checkIs(colorAt(detail, surface, kMiddle),
          shownColor(picture, lightnessAround(picture, false), false, {4.25f, 5.25f}, {10.25f, 3.25f}, 0.5f));
  // A corner that does not fade has the former place of one that does.
  surface.fading.coordinate[1] = {0.0f, 0.0f};
  surface.fading.weight[1] = 0.0f;
  checkIs(colorAt(detail, surface, kMiddle), shownColor(picture, lightnessAround(picture, false), false,
                                                        {4.25f, 5.25f}, {10.25f, 3.25f}, 0.4375f));
  // Of two former pieces, what fades is mixed first.
  surface.fading.coordinate[1] = {2.0f, 3.0f};
  surface.fading.weight[1] = 0.25f;
  const Image around = lightnessAround(picture, false);
  const Reading one = readAt(picture, around, false, {10.25f, 3.25f}),
                other = readAt(picture, around, false, {1.25f, 3.25f});
  const Reading former{one.color * 0.75f + other.color * 0.25f, one.mean * 0.75f + other.mean * 0.25f};
  checkIs(colorAt(detail, surface, kMiddle),
          faded(readAt(picture, around, false, {4.25f, 5.25f}), former, 0.5f));
}

TEST_CASE("color between: means for fades are taken over as much of a finer picture") {
  // Every pixel of the exemplar as 8 x 8.
  const Image picture = blobImage(64, 48, 4, 24.0, 3);
  const Image fine = imageOf(512, 384, 4, [&](int x, int y, int c) { return picture.at(x / 8, y / 8)[c]; });
  TexturedSurface surface = oneTriangle();
  surface.exemplarWidth = 64;
  surface.exemplarHeight = 48;
  surface.coordinate = {{14.0f, 15.0f}, {15.0f, 15.0f}, {14.0f, 16.0f}};
  surface.fading.coordinate = {{40.0f, 33.0f}, {41.0f, 33.0f}, {40.0f, 34.0f}};
  surface.fading.weight = {0.5f, 0.5f, 0.5f};
  const auto shown = [&](const Image& image) {
    const auto color = colorAt(makeDetail(image, false, 64), surface, {1.0f, 0.0f, 0.0f});
    REQUIRE(color);
    return *color;
  };
  CHECK((shown(picture) - shown(fine)).length() < 0.02f);
}

TEST_CASE("color between: whether a picture is seen through") {
  Image picture = ramp(1);
  CHECK_FALSE(makeDetail(picture, false, 16).seeThrough);
  picture.at(3, 3)[3] = 0.5f;
  CHECK(makeDetail(picture, false, 16).seeThrough);
}
