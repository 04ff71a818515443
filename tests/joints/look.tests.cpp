#include "tools/joints/look.h"

#include "tests/joints/samples.h"
#include "tests/texture/joints/sheets.h"
#include "tests/threads.h"

#include <catch2/catch.hpp>

using namespace fluidtex;
using namespace fluidtex::joints;
using namespace fluidtex::testing;
using texture::Vec3f;

namespace {

// A sheet of 0.9 m a side from 3 m above, 1 cm a pixel; its left and right half are of two pieces, which meet
// in the squares from x = 0.4 to 0.5.
struct FromAbove {
  texture::TexturedSurface surface = [] {
    texture::TexturedSurface sheet = flatSheet(10);
    layPieces(
        {Piece{{3, 3}, {{10, 0, 0}, {0, 10, 0}}}, Piece{{40, 20}, {{0, -10, 0}, {10, 0, 0}}}},
        [](const Vec3f& x) { return x.x() < 0.45f ? 0u : 1u; }, true, sheet);
    return sheet;
  }();
  texture::Detail detail = noise();
  texture::Joints joints = texture::findJoints(surface, true);
  texture::CutSurface cut = texture::cutAtJoints(surface, true);
  texture::Joints cutJoints = texture::findJoints(cut.surface, true);
  std::vector<Way> ways = waysToDraw(detail, surface, joints, cut, cutJoints);

  Seen seen() const {
    const double fov = 2.0 * std::atan(0.5 / 3.0) * 180.0 / std::numbers::pi;
    const render::CameraRays camera =
        render::makeCamera({{0.45, 0.45, 3.0}, {0.45, 0.45, 0.0}, fov, 0.0}, 100, 100, 0.0);
    return look(surface, joints, cut, true, ways, camera, {100, 100});
  }
};

}  // namespace

TEST_CASE("look: a pixel's place, and whether it lies in a joint") {
  const Seen seen = FromAbove().seen();
  for (int y = 0; y < 100; ++y)
    for (int x = 0; x < 100; ++x) {
      const auto pixel = std::size_t(100 * y + x);
      const Vec3f centre(0.01f * (float(x) - 4.5f), 0.01f * (94.5f - float(y)), 0.0f);
      const bool inside = x >= 5 && x < 95 && y >= 5 && y < 95;
      INFO(x << " " << y);
      // A column at an edge may belong to either side of it.
      if (x % 10 == 4 || x % 10 == 5 || y % 10 == 4 || y % 10 == 5) continue;
      REQUIRE((seen.kind[pixel] == Kind::nothing) == !inside);
      if (!inside) continue;
      CHECK((seen.position[pixel] - centre).length() < 1e-4f);
      CHECK(seen.kind[pixel] == (x > 45 && x < 54 ? Kind::joint : Kind::elsewhere));
    }
}

TEST_CASE("look: its lightness is the mean of what the way shows there") {
  const FromAbove scene;
  const Seen seen = scene.seen();
  // Each way, at 16 points of a pixel in the joint; which triangle of its square each lies in, from its
  // place.
  const int x = 47, y = 43;
  double sum = 0.0;
  for (int i = 0; i < 16; ++i) {
    const float px = 0.01f * (float(x) + (float(i % 4) + 0.5f) / 4.0f - 5.0f),
                py = 0.01f * (95.0f - float(y) - (float(i / 4) + 0.5f) / 4.0f);
    const int column = int(px / 0.1f), row = int(py / 0.1f);
    const float u = px / 0.1f - float(column), v = py / 0.1f - float(row);
    Place place;
    place.triangle = std::uint32_t(2 * (9 * row + column)) + (u < v);
    place.weights = u >= v ? Vec3f(1 - u, u - v, v) : Vec3f(1 - v, u, v - u);
    const texture::Vec4f color = scene.ways[1].color(place);
    sum += texture::luminance(color.asPointer()) / 16.0;
  }
  REQUIRE(seen.kind[std::size_t(100 * y + x)] == Kind::joint);
  CHECK(seen.lightness[1][std::size_t(100 * y + x)] == Approx(texture::encodeSrgb(float(sum))).margin(1e-3));
}

TEST_CASE("look: the same on any number of threads") {
  const FromAbove scene;
  const Seen one = onThreads(1, [&] { return scene.seen(); }),
             four = onThreads(4, [&] { return scene.seen(); });
  CHECK(one.kind == four.kind);
  CHECK(one.lightness == four.lightness);
}

TEST_CASE("look: a triangle of one piece across the edge of a toroidal exemplar is no joint") {
  texture::TexturedSurface sheet = flatSheet(10);
  layPieces(
      {Piece{{60, 3}, {{10, 0, 0}, {0, 10, 0}}}}, [](const Vec3f&) { return 0u; }, true, sheet);
  const texture::Joints joints = texture::findJoints(sheet, true);
  REQUIRE_FALSE(joints.joints.empty());
  for (const texture::Joint& joint : joints.joints)
    CHECK_FALSE(isOfSeveralPieces(joint, texture::Torus(sheet, true)));
}
