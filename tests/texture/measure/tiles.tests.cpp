#include "texture/measure/tiles.h"

#include "tests/texture/measure/sheet.h"
#include "texture/exemplar/srgb.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

using namespace fluidtex::testing;
using Catch::Matchers::WithinAbs;

namespace {

Image plainColor(const Vec4f& color) {
  return paint(32, 32, [&](float, float, float* c) { std::copy_n(color.asPointer(), 4, c); });
}

std::array<float, 4> perceptual(std::array<float, 4> color, int channels) {
  toPerceptual(color.data(), channels);
  return color;
}

}  // namespace

TEST_CASE("tiles: dice are even, within their limits, and the same of the same seed", "[texture]") {
  constexpr int kThrows = 60000;
  Dice dice(3), same(3), other(4);
  double sum = 0.0, squares = 0.0;
  std::array<int, 6> fell{};
  int unlike = 0;
  for (int i = 0; i < kThrows; ++i) {
    const double x = dice.unit();
    REQUIRE((x >= 0.0 && x < 1.0));
    REQUIRE(same.unit() == x);
    unlike += other.unit() != x;
    const double y = dice.normal();
    REQUIRE(same.normal() == y);
    sum += y, squares += y * y;
    const std::uint64_t n = dice.below(6);
    REQUIRE(n < 6);
    REQUIRE(same.below(6) == n);
    ++fell[n];
  }
  CHECK(unlike > kThrows - 10);
  // Five standard deviations each.
  CHECK_THAT(sum / kThrows, WithinAbs(0.0, 5.0 / std::sqrt(kThrows)));
  CHECK_THAT(squares / kThrows, WithinAbs(1.0, 5.0 * std::sqrt(2.0 / kThrows)));
  for (const int n : fell) CHECK_THAT(n, WithinAbs(kThrows / 6.0, 5.0 * std::sqrt(kThrows * 5.0 / 36.0)));
}

TEST_CASE("tiles: the ground knows two rings around each vertex, and the spacing", "[texture]") {
  const TexturedSurface surface = sheet(stripes(64), asItIs);
  const TileGround ground(surface);
  CHECK(ground.spacing == 1.0);
  for (std::uint32_t v = 0; v < surface.positions.size(); v += 17) {
    const auto ring = ground.around.around(v);
    REQUIRE(ring[0] == v);
    std::set<std::uint32_t> expected{v};
    for (const std::uint32_t u : ground.graph.around(v)) {
      expected.insert(u);
      for (const std::uint32_t w : ground.graph.around(u)) expected.insert(w);
    }
    REQUIRE(std::set<std::uint32_t>(ring.begin(), ring.end()) == expected);
    REQUIRE(ring.size() == expected.size());
  }
}

TEST_CASE("tiles: a reading is of the nearest vertices, with weights of sum one", "[texture]") {
  const TexturedSurface surface = sheet(stripes(64), asItIs);
  const TileGround ground(surface);
  std::uint32_t at = 0;
  const Vec3f middle(48.0f, 40.0f, 4.0f);
  while ((surface.positions[at] - middle).lengthSqr() > 1e-6f) ++at;
  const Vec3f x = middle + Vec3f(0.3f, -0.1f, 0.0f);
  for (const bool without : {false, true}) {
    SmoothReading found;
    const double distance = readAt(ground, x, at, without, found);
    float sum = 0.0f, last = 0.0f;
    std::set<std::uint32_t> read;
    for (const auto& [weight, u] : found) {
      const float d = (surface.positions[u] - x).length();
      CHECK(d >= last);
      last = d;
      sum += weight;
      read.insert(u);
    }
    CHECK_THAT(sum, WithinAbs(1.0, 1e-6));
    CHECK(read.size() == std::size_t(kReadFrom));
    CHECK(read.count(at) == (without ? 0u : 1u));
    CHECK_THAT(distance, WithinAbs(without ? std::hypot(0.7, 0.1) : std::hypot(0.3, 0.1), 1e-5));
    // No vertex outside is nearer, but the one that is left out.
    int nearer = 0;
    for (std::uint32_t u = 0; u < surface.positions.size(); ++u)
      nearer += (surface.positions[u] - x).length() < last && !(without && u == at);
    CHECK(nearer < kReadFrom);
  }
}

TEST_CASE("tiles: on a level sheet they are as many and as large as asked, and undistorted", "[texture]") {
  const TexturedSurface surface = sheet(stripes(64), asItIs);
  const TileGround ground(surface);
  Dice dice(1);
  const int size = GENERATE(15, 16);
  const std::vector<Tile> tiles = flatTiles(ground, size, 12, dice);
  REQUIRE(tiles.size() == 12);
  int whole = 0;
  for (const Tile& tile : tiles) {
    REQUIRE(tile.texels.size() == std::size_t(size * size));
    REQUIRE(tile.flat.size() == tile.vertex.size());
    CHECK(std::set<std::uint32_t>(tile.vertex.begin(), tile.vertex.end()).size() == tile.vertex.size());
    // A tile may hang a little over the rim.
    if (std::any_of(tile.vertex.begin(), tile.vertex.end(),
                    [&](std::uint32_t v) { return surface.trust[v] == 0.0f; }))
      continue;
    ++whole;
    for (std::size_t i = 1; i < tile.vertex.size(); ++i) {
      const Vec3f apart = surface.positions[tile.vertex[i]] - surface.positions[tile.vertex[0]];
      REQUIRE_THAT((tile.flat[i] - tile.flat[0]).length(), WithinAbs(apart.length(), 1e-4));
    }
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) {
        const Tile::Reading& texel = tile.texels[std::size_t(y * size + x)];
        Vec2f place(0.0f);
        float sum = 0.0f;
        for (std::size_t i = 0; i < std::size_t(kReadFrom); ++i) {
          REQUIRE(texel.index[i] < tile.vertex.size());
          place += tile.flat[texel.index[i]] * texel.weight[i];
          sum += texel.weight[i];
        }
        REQUIRE_THAT(sum, WithinAbs(1.0, 1e-5));
        // Six vertices on one side more than on the other draw the mean towards them.
        const float middle = 0.5f * float(size - 1);
        REQUIRE((place - Vec2f(float(x) - middle, float(y) - middle)).length() < 0.25f);
      }
  }
  CHECK(whole > 6);
}

TEST_CASE("tiles: none where the surface bends too much", "[texture]") {
  const TexturedSurface ball = bareBall(12);
  const TileGround ground(ball);
  // A tile that covers the square of sides 1.9 of a ball of radius 1 bends by 60 degrees at its corners.
  Dice dice(1);
  CHECK(flatTiles(ground, int(1.9 / ball.spacing), 5, dice).empty());
  CHECK(flatTiles(ground, int(0.5 / ball.spacing), 5, dice).size() == 5);
}

TEST_CASE("tiles: what is see-through is seen over mid grey", "[texture]") {
  const float grey = decodeSrgb(0.5f), light = decodeSrgb(0.9f);
  const auto check = [](const Vec4f& color, float expected) {
    const Vec3f seen = seenColor(color);
    for (int c = 0; c < 3; ++c) CHECK_THAT(seen[c], WithinAbs(expected, 1e-5));
  };
  check({light, light, light, 1.0f}, 0.9f);
  check({light, light, light, 0.25f}, 0.6f);
  check({light, light, light, 0.0f}, 0.5f);
  check({grey, grey, grey, 0.3f}, 0.5f);

  Image two{2, 1, 4, {light, 0.0f, grey, 1.0f, 1.0f, 1.0f, 1.0f, 0.5f}};
  const Image picture = seenPicture(two);
  REQUIRE((picture.width == 2 && picture.height == 1 && picture.channels == 3));
  const std::vector<float> expected{0.9f, 0.0f, 0.5f, 0.75f, 0.75f, 0.75f};
  CHECK(largestDifference(picture.data, expected) < 1e-5f);
  const Image brightness = seenLuminance(two);
  REQUIRE((brightness.channels == 1 && brightness.data.size() == 2));
  CHECK_THAT(brightness.data[0], WithinAbs(0.2126 * 0.9 + 0.0722 * 0.5, 1e-5));
  CHECK_THAT(brightness.data[1], WithinAbs(0.75, 1e-5));
  TexturedSurface surface;
  surface.color = {Vec4f(two.data.data()), Vec4f(two.data.data() + 4)};
  const std::vector<Vec3f> colors = seenColors(surface);
  REQUIRE(colors.size() == 2);
  CHECK(colors[0] == Vec3f(picture.data.data()));
  CHECK(colors[1] == Vec3f(picture.data.data() + 3));
}

TEST_CASE("tiles: a picture has alpha only where it is not opaque", "[texture]") {
  const float light = decodeSrgb(0.9f);
  const Image opaque = encodedPicture(plainColor({light, 0.0f, 1.0f, 1.0f}));
  REQUIRE(opaque.channels == 3);
  REQUIRE(opaque.data.size() == 32 * 32 * 3);
  CHECK_THAT(opaque.data[0], WithinAbs(0.9, 1e-5));
  CHECK(opaque.data[1] == 0.0f);
  Image color = plainColor({light, 0.0f, 1.0f, 1.0f});
  color.at(31, 31)[3] = 0.5f;
  const Image clear = encodedPicture(color);
  REQUIRE(clear.channels == 4);
  CHECK(clear.at(0, 0)[3] == 1.0f);
  CHECK(clear.at(31, 31)[3] == 0.5f);
  CHECK_THAT(clear.at(31, 31)[0], WithinAbs(0.9, 1e-5));
}

TEST_CASE("tiles: percentiles", "[texture]") {
  CHECK(percentile({}, 0.5) == 0.0);
  CHECK(percentile({3.0f}, 0.0) == 3.0);
  CHECK(percentile({3.0f}, 1.0) == 3.0);
  std::vector<float> values;
  for (int i = 0; i < 1000; ++i) values.push_back(float(i * 377 % 1000));
  CHECK(percentile(values, 0.0) == 0.0);
  CHECK(percentile(values, 0.5) == 500.0);
  CHECK(percentile(values, 0.999) == 999.0);
  CHECK(percentile(values, 1.0) == 999.0);
}

TEST_CASE("tiles: colours as CIELAB", "[texture]") {
  const auto check = [](const std::array<float, 4>& lab, double l, double a, double b) {
    CHECK_THAT(lab[0], WithinAbs(l, 2e-3));
    CHECK_THAT(lab[1], WithinAbs(a, 2e-3));
    CHECK_THAT(lab[2], WithinAbs(b, 2e-3));
  };
  check(perceptual({0, 0, 0, 0}, 3), 0.0, 0.0, 0.0);
  check(perceptual({1, 1, 1, 0}, 3), 1.0, 0.0, 0.0);
  // Mid grey: luminance 0.2140.
  check(perceptual({0.5f, 0.5f, 0.5f, 0}, 3), 1.16 * std::cbrt(0.21404) - 0.16, 0.0, 0.0);
  // The primaries under D65, as tables give them.
  check(perceptual({1, 0, 0, 0}, 3), 0.5324, 0.8009, 0.6720);
  check(perceptual({0, 1, 0, 0}, 3), 0.8773, -0.8618, 0.8318);
  check(perceptual({0, 0, 1, 0}, 3), 0.3230, 0.7919, -1.0786);
  // Over mid grey, with alpha kept.
  const auto grey = perceptual({0.5f, 0.5f, 0.5f, 0}, 3);
  const auto clear = perceptual({1.0f, 0.0f, 0.3f, 0.0f}, 4);
  for (std::size_t c = 0; c < 3; ++c) CHECK(clear[c] == grey[c]);
  CHECK(clear[3] == 0.0f);
  const auto part = perceptual({1.0f, 1.0f, 1.0f, 0.5f}, 4), over = perceptual({0.75f, 0.75f, 0.75f, 0}, 3);
  for (std::size_t c = 0; c < 3; ++c) CHECK(part[c] == over[c]);
  CHECK(part[3] == 0.5f);
}

TEST_CASE("tiles: a picture is mirrored at the centres of its outermost texels", "[texture]") {
  const Image picture =
      paint(5, 3, [](float x, float y, float* c) { c[0] = x, c[1] = y, c[2] = x * x, c[3] = x * y; });
  const auto at = [&](double x, double y) {
    std::array<float, 4> out{};
    sampleMirrored(picture, x, y, out.data());
    return out;
  };
  const auto inside = at(2.25, 1.5);
  CHECK_THAT(inside[0], WithinAbs(2.25, 1e-6));
  CHECK_THAT(inside[1], WithinAbs(1.5, 1e-6));
  CHECK_THAT(inside[2], WithinAbs(0.75 * 4 + 0.25 * 9, 1e-6));
  CHECK_THAT(inside[3], WithinAbs(2.25 * 1.5, 1e-6));
  for (const double t : {0.0, 0.3, 1.0, 1.75})
    for (std::size_t c = 0; c < 4; ++c) {
      CHECK_THAT(at(-t, 0.6)[c], WithinAbs(at(t, 0.6)[c], 1e-5));
      CHECK_THAT(at(4.0 + t, 0.6)[c], WithinAbs(at(4.0 - t, 0.6)[c], 1e-5));
    }
  CHECK_THAT(at(-0.75, 0.0)[0], WithinAbs(0.75, 1e-6));
  CHECK_THAT(at(4.75, 0.0)[0], WithinAbs(3.25, 1e-6));
  CHECK_THAT(at(8.5, 0.0)[0], WithinAbs(0.5, 1e-6));  // once around, 2 x 4 texels
  CHECK_THAT(at(0.0, -0.5)[1], WithinAbs(0.5, 1e-6));
  CHECK_THAT(at(0.0, 2.5)[1], WithinAbs(1.5, 1e-6));
  const Image one{1, 1, 1, {0.7f}};
  float value = 0.0f;
  sampleMirrored(one, -3.3, 8.9, &value);
  CHECK_THAT(value, WithinAbs(0.7, 1e-6));
}

TEST_CASE("tiles: of a plain colour they are plain, on the surface and of the exemplar", "[texture]") {
  const Vec4f color(decodeSrgb(0.8f), decodeSrgb(0.3f), decodeSrgb(0.1f), 0.5f);
  const Image exemplar = plainColor(color);
  TexturedSurface surface = sheet(exemplar, asItIs);
  surface.color.assign(surface.positions.size(), color);
  const TileGround ground(surface);
  Dice dice(1);
  const std::vector<Tile> tiles = flatTiles(ground, 9, 3, dice);
  REQUIRE(tiles.size() == 3);
  const auto expected = perceptual({0.8f, 0.3f, 0.1f, 0.5f}, 4);
  const auto check = [&](const Stack& stack, int count) {
    REQUIRE((stack.count == count && stack.height == 9 && stack.width == 9 && stack.channels == 4));
    REQUIRE(stack.data.size() == std::size_t(count) * 9 * 9 * 4);
    for (std::size_t i = 0; i < stack.data.size(); ++i)
      REQUIRE_THAT(stack.data[i], WithinAbs(expected[i % 4], 1e-4));
  };
  check(colorTiles(surface, tiles, 9, 4), 3);
  const Image picture = encodedPicture(exemplar);
  check(exemplarTiles(picture, tiles, 9, 2, dice), 3);
  check(exemplarTiles(picture, tiles, 9, 8, dice), 8);
}

TEST_CASE("tiles: a stack's texels lie by picture, row, column and channel", "[texture]") {
  Stack stack(2, 3, 4, 5);
  CHECK(stack.data == std::vector<float>(120, 0.0f));
  CHECK(stack.at(1, 2, 3) - stack.data.data() == ((1 * 3 + 2) * 4 + 3) * 5);
}
