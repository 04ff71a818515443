#include "texture/measure/wear.h"

#include "tests/texture/measure/sheet.h"
#include "texture/exemplar/srgb.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex::testing;
using Catch::Matchers::WithinAbs;

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

TEST_CASE("wear: what only moves and turns is not worn", "[texture]") {
  TexturedSurface surface = sheet(cells(64), asItIs);
  for (Vec3f& x : surface.previousPosition)
    x = Vec3f(0.8f * x.x() - 0.6f * x.y() + 5.0f, 0.6f * x.x() + 0.8f * x.y(), x.z() - 2.0f);
  const auto found = measureFlowWear(surface, 0.5);
  REQUIRE(found);
  CHECK_THAT(found->worn, WithinAbs(0.0, 1e-5));
}

TEST_CASE("wear: no more is worn than there is", "[texture]") {
  TexturedSurface surface = sheet(cells(64), asItIs);
  for (Vec3f& x : surface.previousPosition) x = Vec3f(0.45f * x.x(), x.y(), x.z());
  const auto found = measureFlowWear(surface, 0.25);
  REQUIRE(found);
  CHECK(found->worn == 1.0);
  CHECK_THAT(found->change, WithinAbs(std::sqrt(2.0) * 0.25, 1e-12));
}

TEST_CASE("wear: the change goes by the rms of what is worn, not by its mean", "[texture]") {
  TexturedSurface surface = sheet(cells(64), asItIs);
  // One half at rest, the other drawn out by 1.4: half of it is worn.
  const float middle = 0.5f * kAcross;
  for (Vec3f& x : surface.previousPosition)
    if (x.x() > middle) x.x() = middle + (x.x() - middle) / 1.4f;
  const auto found = measureFlowWear(surface, 1.0);
  REQUIRE(found);
  // But for the columns between the halves, where strain is averaged.
  CHECK_THAT(found->worn, WithinAbs(0.25, 0.01));
  CHECK_THAT(found->change, WithinAbs(0.5, 0.02));
}

TEST_CASE("wear: the deviation of luminance is that of the picture as it is seen", "[texture]") {
  const auto squares = [](float dark, float light, float alpha) {
    return paint(8, 8, [=](float x, float y, float* c) {
      c[0] = c[1] = c[2] = decodeSrgb((int(x) + int(y)) % 2 == 0 ? dark : light);
      c[3] = alpha;
    });
  };
  CHECK_THAT(deviationOfLuminance(squares(0.0f, 1.0f, 1.0f)), WithinAbs(0.5, 1e-5));
  CHECK_THAT(deviationOfLuminance(squares(0.2f, 0.6f, 1.0f)), WithinAbs(0.2, 1e-5));
  CHECK_THAT(deviationOfLuminance(squares(0.2f, 0.6f, 0.5f)), WithinAbs(0.1, 1e-5));
  CHECK_THAT(deviationOfLuminance(squares(0.2f, 0.6f, 0.0f)), WithinAbs(0.0, 1e-5));
  CHECK_THAT(deviationOfLuminance(squares(0.4f, 0.4f, 1.0f)), WithinAbs(0.0, 1e-3));
}
