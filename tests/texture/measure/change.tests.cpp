#include "texture/measure/change.h"

#include "tests/texture/measure/sheet.h"
#include "tests/threads.h"
#include "texture/exemplar/srgb.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex::testing;
using Catch::Matchers::WithinAbs;

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

TEST_CASE("change: where there was no surface, nothing has changed", "[texture]") {
  const Image picture = stripes(64);
  const TexturedSurface before = sheet(picture, asItIs);
  TexturedSurface after = before;
  CHECK_FALSE(measureChange({}, after, picture, true));
  CHECK_FALSE(measureChange(before, {}, picture, true));
  // White where it comes from farther away than a quarter of the spacing.
  for (std::size_t v = 0; v < after.positions.size(); v += 5) {
    after.color[v] = Vec4f(1.0f);
    after.previousPosition[v] += after.normals[v] * 0.26f;
  }
  const auto off = measureChange(before, after, picture, true);
  REQUIRE(off);
  CHECK(off->pop == 0.0);
  for (std::size_t v = 0; v < after.positions.size(); v += 5)
    after.previousPosition[v] = after.positions[v] + after.normals[v] * 0.24f;
  CHECK(measureChange(before, after, picture, true)->pop > 0.3);
  for (Vec3f& x : after.previousPosition) x.z() += 100.0f;
  CHECK_FALSE(measureChange(before, after, picture, true));
}

TEST_CASE("change: the ratio is one where the texture has nothing to do with the last", "[texture]") {
  const Image picture = stripes(64);
  const TexturedSurface before = sheet(picture, asItIs), fresh = sheet(picture, blocks(8, 64));
  const auto change = measureChange(before, fresh, picture, true);
  REQUIRE(change);
  // 9000 vertices on either side, in 144 blocks that are each as like or unlike as chance has it.
  CHECK_THAT(change->ratio, WithinAbs(1.0, 0.1));
}

TEST_CASE("change: the same on one thread and on two", "[texture]") {
  const Image picture = stripes(64);
  const TexturedSurface before = sheet(picture, asItIs), after = sheet(picture, turned);
  const auto on = [&](int threads) {
    return *onThreads(threads, [&] { return measureChange(before, after, picture, true); });
  };
  const Change one = on(1), two = on(2);
  CHECK(one.pop == two.pop);
  CHECK(one.change == two.change);
  CHECK(one.alongFlow == two.alongFlow);
  CHECK(one.ratio == two.ratio);
}
