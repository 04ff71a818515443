// The figures of a texture, on surfaces where they are known.
#include "texture/measure/measure.h"

#include "tests/texture/exemplar/sample_images.h"
#include "tests/texture/mesh/closed_meshes.h"
#include "texture/exemplar/srgb.h"
#include "texture/labels/labels.h"
#include "texture/measure/change.h"
#include "texture/measure/contrast.h"
#include "texture/measure/pieces.h"
#include "texture/measure/wear.h"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <functional>

using namespace fluidtex::testing;
using Catch::Matchers::WithinAbs;
using fluidtex::randomUnit;

namespace {

constexpr int kAcross = 96;  // squares of the sheet's sides

// Where in the exemplar a vertex at (x, y), texels, comes from.
using Layout = std::function<Vec2f(const Vec2f&)>;

// A thin level sheet whose vertices show the exemplar at their place on it. On its rim, where it is no sheet,
// the surface counts as new, unless all is.
TexturedSurface sheet(const Image& color, const Layout& layout, bool known = true) {
  const SurfaceMesh mesh = boxMesh({0, 0, 0}, {kAcross, kAcross, 4}, {kAcross, kAcross, 4});
  TexturedSurface surface;
  surface.spacing = 1.0;
  surface.positions = surface.previousPosition = mesh.positions;
  surface.triangles = mesh.triangles;
  surface.exemplarWidth = color.width;
  surface.exemplarHeight = color.height;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const bool level = std::abs(mesh.normals[v].z()) > 0.9f;
    const Vec3f n = level ? mesh.normals[v] : Vec3f(0, 0, mesh.positions[v].z() > 2.0f ? 1.0f : -1.0f);
    const Vec3f d(1, 0, 0), b = rowAxis(d, n);
    surface.normals.push_back(n);
    surface.orientation.push_back(d);
    surface.trust.push_back(level && known ? 1.0f : 0.0f);
    const Vec2f texel = layout(Vec2f(mesh.positions[v].dot(d), mesh.positions[v].dot(b)));
    surface.coordinate.push_back(texel);
    Vec4f shown;
    sampleCubic(color, true, texel, shown.asPointer());
    surface.color.push_back(shown);
  }
  surface.age.assign(surface.positions.size(), 0.0f);
  surface.gradient.resize(surface.positions.size());
  return surface;
}

Vec2f asItIs(const Vec2f& l) {
  return l;
}

// Between the exemplar's texels, as on any surface.
Vec2f turned(const Vec2f& l) {
  return {0.8f * l[0] - 0.6f * l[1] + 0.37f, 0.6f * l[0] + 0.8f * l[1] + 0.21f};
}

// The exemplar cut into blocks of `size` texels, each from a place of its own.
Layout blocks(int size, int exemplar) {
  return [=](const Vec2f& l) {
    const auto i = std::int64_t(std::floor((l[0] + 1000.0f) / float(size)));
    const auto j = std::int64_t(std::floor((l[1] + 1000.0f) / float(size)));
    const std::uint64_t block = std::uint64_t(i * 4096 + j) * 2;
    return l + Vec2f(float(exemplar * randomUnit(9, block)), float(exemplar * randomUnit(9, block + 1)));
  };
}

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

TEST_CASE("measure: what is carried does not change", "[texture]") {
  const Image picture = stripes(64);
  const TexturedSurface before = sheet(picture, asItIs);
  const auto still = measureChange(before, before, picture, true);
  REQUIRE(still);
  CHECK(still->pop == 0.0);
  CHECK(still->change == 0.0);
  CHECK(still->renewed == 0.0);

  // The sheet moves by 3.3 texels along x, its texture with it: only resampling is left.
  TexturedSurface moved = sheet(picture, [](const Vec2f& l) { return Vec2f(l[0] - 3.3f, l[1]); });
  for (std::size_t v = 0; v < moved.positions.size(); ++v) {
    moved.previousPosition[v] = moved.positions[v] - Vec3f(3.3f, 0, 0);
    if (moved.previousPosition[v].x() < 0.0f) moved.trust[v] = 0.0f;
  }
  const auto carried = measureChange(before, moved, picture, true);
  REQUIRE(carried);
  CHECK(carried->change < 1e-6);
  CHECK(carried->renewed == 0.0);
  CHECK(carried->pop > 0.0);
  CHECK(std::abs(carried->ratio) < 0.2);
  TexturedSurface stuck = before;
  stuck.previousPosition = moved.previousPosition;
  stuck.trust = moved.trust;
  const auto renewed = measureChange(before, stuck, picture, true);
  CHECK(renewed->renewed == 1.0);
  CHECK(renewed->change > 10.0 * carried->change + 0.01);
}

TEST_CASE("measure: what the flow wears out follows from its strain, whatever the texture", "[texture]") {
  const Image picture = paint(64, 64, [](float, float y, float* c) {
    c[0] = c[1] = c[2] = int(y) % 16 < 8 ? 0.0f : 1.0f, c[3] = 1.0f;
  });
  const auto still = measureFlowWear(sheet(picture, asItIs), 0.5);
  REQUIRE(still);
  CHECK_THAT(still->worn, WithinAbs(0.0, 1e-5));
  CHECK_THAT(still->change, WithinAbs(0.0, 1e-5));

  // Drawn out along x by 5%, squeezed as much across.
  const float strain = 0.05f;
  const auto drawn = [&](const Layout& layout) {
    TexturedSurface surface = sheet(picture, layout);
    for (Vec3f& x : surface.previousPosition)
      x = Vec3f(x.x() * std::exp(-strain), x.y() * std::exp(strain), x.z());
    return measureFlowWear(surface, deviationOfLuminance(picture));
  };
  const auto found = drawn(asItIs);
  REQUIRE(found);
  const double worn = strain / (2.0 * std::log(1.4));
  CHECK_THAT(found->worn, WithinAbs(worn, 0.02 * worn));
  CHECK(drawn(turned)->worn == found->worn);
  CHECK_THAT(found->change, WithinAbs(std::sqrt(2.0) * 0.5 * found->worn, 0.02 * found->worn));

  TexturedSurface fresh = sheet(picture, asItIs, false);
  CHECK_FALSE(measureFlowWear(fresh, 0.5));
}

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

TEST_CASE("measure: renewed surface changes by what is shown instead", "[texture]") {
  // Light above, dark below: a vertex that goes from one to the other changes by their difference.
  const Image picture = paint(64, 64, [](float, float y, float* c) {
    c[0] = c[1] = c[2] = y < 32.0f ? decodeSrgb(0.25f) : decodeSrgb(0.75f);
    c[3] = 1.0f;
  });
  const auto level = [](float t) {
    return [=](const Vec2f& l) { return Vec2f(l[0], t + 0.05f * l[1] / kAcross); };
  };
  const TexturedSurface before = sheet(picture, level(16.0f));
  TexturedSurface after = before;
  const TexturedSurface other = sheet(picture, level(48.0f));
  int renewed = 0, counted = 0;
  for (std::size_t v = 0; v < after.positions.size(); ++v) {
    if (after.trust[v] < 0.5f) continue;
    ++counted;
    if (v % 10 != 0) continue;
    ++renewed;
    after.coordinate[v] = other.coordinate[v];
    after.color[v] = other.color[v];
  }
  const double share = double(renewed) / counted;
  const auto change = measureChange(before, after, picture, true);
  REQUIRE(change);
  CHECK_THAT(change->renewed, WithinAbs(share, 1e-9));
  CHECK_THAT(change->change, WithinAbs(0.5 * std::sqrt(share), 1e-4));
  CHECK_THAT(change->pop, WithinAbs(0.5, 1e-4));

  // A fade: the colours go half the way, whatever the coordinates say already.
  TexturedSurface fading = after;
  const float grey = decodeSrgb(0.5f);
  for (std::size_t v = 0; v < fading.positions.size(); ++v)
    if (fading.coordinate[v] != before.coordinate[v]) fading.color[v] = Vec4f(grey, grey, grey, 1.0f);
  const auto begun = measureChange(before, fading, picture, true);
  const auto ended = measureChange(fading, after, picture, true);
  REQUIRE((begun && ended));
  CHECK_THAT(begun->change, WithinAbs(0.25 * std::sqrt(share), 1e-4));
  CHECK_THAT(ended->change, WithinAbs(0.25 * std::sqrt(share), 1e-4));
  CHECK(ended->renewed == 0.0);
}

TEST_CASE("measure: a change of what nobody sees is none", "[texture]") {
  Image picture = clouds(64);
  for (std::size_t i = 0; i < picture.data.size(); i += 4) picture.data[i + 3] = i % 32 < 16 ? 0.0f : 1.0f;
  TexturedSurface before = sheet(picture, asItIs), after = before;
  for (std::size_t v = 0; v < after.color.size(); ++v) {
    before.color[v] = after.color[v] = straight(before.color[v]);
    if (after.color[v][3] < 0.01f) after.color[v] = Vec4f(1.0f, 0.0f, 1.0f, 0.0f);
  }
  const auto hidden = measureChange(before, after, picture, true);
  REQUIRE(hidden);
  CHECK(hidden->pop == 0.0);
  // A hole that closes is seen.
  for (Vec4f& color : after.color) color[3] = 1.0f;
  CHECK(measureChange(before, after, picture, true)->pop > 0.3);
}

TEST_CASE("measure: surface that is new is left out of what changes", "[texture]") {
  const Image picture = stripes(64);
  const TexturedSurface before = sheet(picture, asItIs);
  TexturedSurface after = sheet(picture, blocks(8, 64), false);
  CHECK_FALSE(measureChange(before, after, picture, true));
  after = sheet(picture, asItIs);
  for (std::size_t v = 0; v < after.positions.size(); v += 7) {
    after.color[v] = Vec4f(1.0f);
    after.trust[v] = 0.1f;
  }
  CHECK(measureChange(before, after, picture, true)->pop == 0.0);
}
