#include "tools/joints/ways.h"

#include "tests/joints/samples.h"
#include "tests/texture/joints/sheets.h"
#include "texture/exemplar/image.h"

#include <catch2/catch.hpp>

using namespace fluidtex;
using namespace fluidtex::joints;
using namespace fluidtex::testing;
using texture::Vec2f;
using texture::Vec3f;

namespace {

enum { kPoints, kProportion, kEqualPower, kCut };

struct Drawn {
  texture::TexturedSurface surface;
  texture::Detail detail = noise();
  texture::Joints joints = texture::findJoints(surface, true);
  texture::CutSurface cut = texture::cutAtJoints(surface, true);
  texture::Joints cutJoints = texture::findJoints(cut.surface, true);
  std::vector<Way> ways = waysToDraw(detail, surface, joints, cut, cutJoints);

  float lightness(int way, const Place& place) const {
    return lightnessOf(ways[std::size_t(way)].color(place));
  }
};

Vec3f anyWeights(std::uint64_t key) {
  const float a = float(randomUnit(1, key)), b = float(randomUnit(2, key));
  return a + b < 1.0f ? Vec3f(a, b, 1.0f - a - b) : Vec3f(1.0f - a, 1.0f - b, a + b - 1.0f);
}

double deviationOf(const std::vector<float>& values) {
  double sum = 0.0, squares = 0.0;
  for (const float v : values) sum += v, squares += double(v) * v;
  const double mean = sum / double(values.size());
  return std::sqrt(squares / double(values.size()) - mean * mean);
}

}  // namespace

TEST_CASE("ways: outside of joints the look-ups are the same, what fades included") {
  const Drawn drawn{patchedTorus(40, 3)};
  std::size_t compared = 0;
  for (std::uint32_t t = 0; t < drawn.cut.triangle.size(); ++t) {
    Place place;
    place.cutTriangle = t, place.triangle = drawn.cut.triangle[t];
    if (texture::jointIn(drawn.joints, place.triangle) != nullptr) continue;
    place.weights = place.cutWeights = anyWeights(t);
    const float expected = drawn.lightness(kProportion, place);
    CHECK(drawn.lightness(kEqualPower, place) == expected);
    CHECK(drawn.lightness(kCut, place) == Approx(expected).margin(1e-3));
    ++compared;
  }
  CHECK(compared > 100);
}

TEST_CASE("ways: at a corner of a joint every way shows the corner's own texture") {
  const Drawn drawn{patchedTorus(40, 3)};
  REQUIRE(drawn.joints.joints.size() > 100);
  for (const texture::Joint& joint : drawn.joints.joints)
    for (int k = 0; k < 3; ++k) {
      Place place;
      place.triangle = joint.triangle;
      place.weights[k] = 1.0f;
      CHECK(drawn.lightness(kEqualPower, place) == Approx(drawn.lightness(kProportion, place)).margin(1e-4));
    }
}

TEST_CASE("ways: equal power keeps more of the contrast of unrelated texture, and never more than all") {
  texture::TexturedSurface sheet = flatSheet(40);
  layPieces(
      {Piece{{3, 3}, {{10, 0, 0}, {0, 10, 0}}}, Piece{{40, 20}, {{0, -10, 0}, {10, 0, 0}}}},
      [](const Vec3f& x) { return x.x() < 2.0f ? 0u : 1u; }, true, sheet);
  const Drawn drawn{sheet};
  std::vector<float> proportion, equal, own;
  for (const texture::Joint& joint : drawn.joints.joints) {
    if (joint.shown[0] == joint.shown[1] && joint.shown[0] == joint.shown[2]) continue;
    for (std::uint64_t key = 0; key < 40; ++key) {
      Place place;
      place.triangle = joint.triangle;
      // Half-way between a corner of one piece and one of the other.
      const int other = joint.shown[0] == joint.shown[1] ? 2 : 1;
      place.weights[0] = place.weights[other] = 0.5f;
      proportion.push_back(drawn.lightness(kProportion, place));
      equal.push_back(drawn.lightness(kEqualPower, place));
      for (const int corner : {0, other}) {
        place.weights = Vec3f(0.0f);
        place.weights[corner] = 1.0f;
        own.push_back(drawn.lightness(kProportion, place));
      }
    }
  }
  REQUIRE(own.size() > 100);
  CHECK(deviationOf(proportion) < 0.9 * deviationOf(own));
  CHECK(deviationOf(equal) > 1.1 * deviationOf(proportion));
  CHECK(deviationOf(equal) < deviationOf(own));
}

TEST_CASE("ways: the cut surface shows each piece on its side of the joint") {
  const Piece left{{10, 10}, {{10, 0, 0}, {0, 10, 0}}}, right{{40, 20}, {{0, -8, 0}, {12, 3, 0}}};
  texture::TexturedSurface sheet = flatSheet(10);
  layPieces(
      {left, right}, [](const Vec3f& x) { return x.x() < 0.45f ? 0u : 1u; }, true, sheet);
  const Drawn drawn{sheet};
  const auto& s = drawn.cut.surface;
  for (std::uint32_t t = 0; t < s.triangles.size(); ++t) {
    Place place;
    place.triangle = drawn.cut.triangle[t], place.cutTriangle = t;
    place.cutWeights = anyWeights(t);
    const texture::Vec3I& c = s.triangles[t];
    const auto at = [&](const Vec3f& w) {
      return s.positions[c[0]] * w[0] + s.positions[c[1]] * w[1] + s.positions[c[2]] * w[2];
    };
    const Piece& piece = at(Vec3f(1.0f / 3.0f)).x() < 0.45f ? left : right;
    const Vec2f texel = piece.at(at(place.cutWeights));
    const float expected =
        lightnessOf(texture::straight(texture::samplePremultiplied(drawn.detail.color, true, texel)));
    CHECK(drawn.lightness(kCut, place) == Approx(expected).margin(2e-3));
  }
}

TEST_CASE("ways: the points' colours are weighted by alpha") {
  texture::TexturedSurface sheet = flatSheet(3);
  layPieces(
      {Piece{{3, 3}, {{10, 0, 0}, {0, 10, 0}}}}, [](const Vec3f&) { return 0u; }, true, sheet);
  const texture::Vec3I corner = sheet.triangles[0];
  sheet.color[corner[0]] = {1, 1, 1, 1}, sheet.color[corner[1]] = {0, 0, 0, 0};
  const Drawn drawn{sheet};
  const texture::Vec4f seen = drawn.ways[kPoints].color({0, 0, {0.25f, 0.75f, 0.0f}, {}});
  CHECK(seen[0] == Approx(1.0f));
  CHECK(seen[3] == Approx(0.25f));
}
