#include "texture/measure/repeats.h"

#include "tests/texture/exemplar/test_images.h"
#include "tests/texture/measure/sheet.h"
#include "texture/orientation/tangent.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex::testing;

namespace {

// Noise, of which no two places are alike.
const Image& noisePicture() {
  static const Image picture = [] {
    Image noise = noiseImage(192, 192, 4, 3);
    for (std::size_t i = 3; i < noise.data.size(); i += 4) noise.data[i] = 1.0f;
    return noise;
  }();
  return picture;
}

double repeatsOn(const TexturedSurface& surface, std::uint64_t seed) {
  Dice dice(seed);
  return repeatsOf(TileGround(surface), encodedPicture(noisePicture()), dice);
}

}  // namespace

TEST_CASE("repeats: none where every place is shown once, all where every place is shown again",
          "[texture]") {
  CHECK(repeatsOn(sheet(noisePicture(), asItIs), 1) == 0.0);
  const auto again = [](float every) {
    return [=](const Vec2f& l) {
      return Vec2f(l[0] - every * std::floor(l[0] / every), l[1] - every * std::floor(l[1] / every));
    };
  };
  const TexturedSurface often = sheet(noisePicture(), again(24.0f));
  CHECK(repeatsOn(often, 1) == 1.0);
  CHECK(repeatsOn(often, 2) == 1.0);
}

TEST_CASE("repeats: what comes again nearer than two windows is no repetition", "[texture]") {
  // Every row is like the one 12 texels from it, and is not shown 24 texels away.
  TexturedSurface surface = sheet(noisePicture(), asItIs);
  for (std::size_t v = 0; v < surface.positions.size(); ++v) {
    const Vec3f& x = surface.positions[v];
    const float side = surface.normals[v].z() > 0.0f ? 96.0f : 0.0f;
    const int pair = int(x.y()) / 24;
    const Vec2f texel(x.x(), side + 24.0f * float(pair) + float(int(x.y()) % 12));
    surface.coordinate[v] = texel;
    sampleCubic(noisePicture(), true, texel, surface.color[v].asPointer());
  }
  CHECK(repeatsOn(surface, 1) == 0.0);
}

TEST_CASE("repeats: a surface too small for a window has none", "[texture]") {
  TexturedSurface ball = bareBall(3);
  for (const Vec3f& n : ball.normals)
    ball.orientation.push_back(tangentUnit(Vec3f(1, 0, 0), n, Vec3f(0, 1, 0)));
  ball.color.assign(ball.positions.size(), Vec4f(0.5f));
  CHECK(repeatsOn(ball, 1) == 0.0);
}
