#include "render/motion_image.h"

#include "tests/render/shapes.h"
#include "tests/scratch.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstring>

namespace fluidtex::render {
namespace {

constexpr double kDistance = 10.0;

// Looks down along -y at the square of 2 m around the origin, one pixel for a 20th of a metre there.
Options lookingAt() {
  Options options;
  options.width = options.height = 40;
  options.camera.from = {0.0, -kDistance, 0.0};
  options.camera.at = {0.0, 0.0, 0.0};
  options.camera.fov = 2.0 * std::atan(1.0 / kDistance) * 180.0 / 3.14159265358979;
  return options;
}

// A sheet in the plane y = 0 that has moved by `step`, of a colour that grows to the right and up with what
// it is made of.
texture::TexturedSurface sheet(const Vec3f& step, float half = 2.0f) {
  texture::TexturedSurface surface;
  constexpr int kSide = 21;
  for (int j = 0; j < kSide; ++j)
    for (int i = 0; i < kSide; ++i) {
      const Vec3f x(half * (0.1f * float(i) - 1.0f), 0.0f, half * (0.1f * float(j) - 1.0f));
      surface.positions.push_back(x);
      surface.previousPosition.push_back(x - step);
      const Vec3f rest = x - step;
      surface.color.emplace_back(0.3f + 0.05f * rest[0], 0.3f + 0.05f * rest[2], 0.3f, 1.0f);
      surface.normals.emplace_back(0.0f, -1.0f, 0.0f);
      surface.trust.push_back(1.0f);
    }
  for (std::uint32_t j = 0; j + 1 < kSide; ++j)
    for (std::uint32_t i = 0; i + 1 < kSide; ++i) {
      const std::uint32_t v = kSide * j + i;
      surface.triangles.emplace_back(v, v + 1, v + kSide + 1);
      surface.triangles.emplace_back(v, v + kSide + 1, v + kSide);
    }
  return surface;
}

MotionImage seen(const texture::TexturedSurface& surface, const Options& options, double now = 0.0) {
  std::vector<Vec3f> colors;
  for (const texture::Vec4f& color : surface.color) colors.emplace_back(color[0], color[1], color[2]);
  return motionImage(surface, colors, options, now, 0.0, 0.5f);
}

}  // namespace

TEST_CASE("motion image: a sheet that has moved by pixels was so many pixels away", "[render]") {
  // Three pixels to the right and one up.
  const MotionImage image = seen(sheet({0.15f, 0.0f, 0.05f}), lookingAt());
  REQUIRE(image.color.size() == 1600);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 40; ++x) {
      const std::size_t pixel = std::size_t(40 * y + x);
      CHECK(image.before[pixel][0] == Approx(x + 0.5 - 3.0).margin(1e-3));
      CHECK(image.before[pixel][1] == Approx(y + 0.5 + 1.0).margin(1e-3));
      const double right = 0.05 * (x - 19.5), up = 0.05 * (19.5 - y);
      CHECK(image.distance[pixel] == Approx(std::hypot(kDistance, right, up)).epsilon(1e-4));
      CHECK(image.distanceBefore[pixel] ==
            Approx(std::hypot(kDistance, right - 0.15, up - 0.05)).epsilon(1e-4));
    }
}

TEST_CASE("motion image: a camera that turns, new surface, and where nothing is", "[render]") {
  Options turning = lookingAt();
  turning.camera.turn = 1.0;
  // The sheet's middle is what the camera looks at: it stays, and a place nearer to the camera moves.
  texture::TexturedSurface still = sheet(Vec3f(0.0f));
  const MotionImage image = seen(still, turning, 1.0);
  CHECK(image.before[820][0] == Approx(20.5).margin(0.05));
  for (Vec3f& x : still.positions) x[1] = -1.0f;
  still.previousPosition = still.positions;
  CHECK(std::abs(seen(still, turning, 1.0).before[820][0] - 20.5f) > 0.2f);

  for (std::size_t v = 0; v < still.trust.size(); ++v)
    if (still.positions[v][0] < 0.0f) still.trust[v] = 0.0f;
  const MotionImage partly = seen(still, lookingAt());
  CHECK(std::isnan(partly.before[805][0]));
  CHECK(std::isfinite(partly.before[835][0]));
  const MotionImage small = seen(sheet(Vec3f(0.0f), 0.5f), lookingAt());
  CHECK(std::isinf(small.distance[0]));
  CHECK(std::isnan(small.before[0][0]));
  CHECK(small.color[0] == Vec3f(0.5f));
  CHECK(std::isinf(seen({}, lookingAt()).distance[820]));
}

TEST_CASE(
    "warp error: none of what moves with the surface, that of a change of colour, none of what is hidden",
    "[render]") {
  const Options options = lookingAt();
  const MotionImage first = seen(sheet(Vec3f(0.0f)), options);
  const texture::TexturedSurface moved = sheet({0.14f, 0.0f, 0.06f});  // 2.8 pixels and 1.2
  const MotionImage second = seen(moved, options);
  const auto carried = warpError(first, second, 0.1);
  REQUIRE(carried);
  CHECK(carried->error < 1e-6);
  // Three columns and two rows have come into the picture.
  CHECK(carried->share == Approx(37.0 * 38.0 / 1600.0));

  MotionImage brighter = second;
  for (Vec3f& color : brighter.color) color += Vec3f(0.1f, 0.0f, 0.2f);
  CHECK(warpError(first, brighter, 0.1)->error == Approx(0.05).epsilon(0.01));
  // A metre nearer a frame ago: what was seen then is another thing.
  MotionImage hidden = second;
  for (float& distance : hidden.distanceBefore) distance += 1.0f;
  CHECK_FALSE(warpError(first, hidden, 0.1));
  CHECK_THROWS_AS(warpError({}, second, 0.1), std::invalid_argument);
}

TEST_CASE("motion image: FLO files hold the motion to the frame before", "[render]") {
  const Scratch folder;
  MotionImage image = seen(sheet({0.15f, 0.0f, 0.05f}), lookingAt());
  image.before[1] = Vec2f(std::nanf(""));
  writeFlo(image, folder.path / "a.flo");
  const std::string bytes = readBytes(folder.path / "a.flo");
  REQUIRE(bytes.size() == 12 + 1600 * 8);
  CHECK(bytes.substr(0, 4) == "PIEH");
  std::int32_t size[2];
  std::memcpy(size, bytes.data() + 4, sizeof size);
  CHECK((size[0] == 40 && size[1] == 40));
  float motion[4];
  std::memcpy(motion, bytes.data() + 12, sizeof motion);
  CHECK(motion[0] == Approx(-3.0f).margin(1e-3));
  CHECK(motion[1] == Approx(1.0f).margin(1e-3));
  CHECK(motion[2] > 1e9f);
  CHECK_THROWS_WITH(writeFlo(image, folder.path / "no" / "a.flo"),
                    Catch::Contains("a.flo: cannot be written"));
}

}  // namespace fluidtex::render
