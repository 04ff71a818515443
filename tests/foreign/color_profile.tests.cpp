#include "foreign/color_profile.h"

#include "tests/foreign/profiles.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace fluidtex::foreign;
using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;

namespace {

std::array<float, 3> light(const ColorProfile& profile, const std::vector<float>& stored) {
  std::array<float, 3> out{};
  profile.toLinear(stored.data(), 1, out.data());
  return out;
}

}  // namespace

TEST_CASE("color profile: a power for each channel, of sRGB's primaries", "[foreign]") {
  for (const double gamma : {1.0, 1.8, 2.2}) {
    const ColorProfile profile(rgbProfile(kSrgbPrimaries, gamma), 3);
    CHECK_FALSE(profile.isSrgb());
    for (const float v : {0.0f, 0.02f, 0.3f, 0.7123f, 1.0f})
      for (std::size_t c = 0; c < 3; ++c) {
        std::vector<float> stored(3, 0.25f);
        stored[c] = v;
        CHECK_THAT(light(profile, stored)[c], WithinAbs(std::pow(v, gamma), 3e-4));
      }
  }
}

TEST_CASE("color profile: one that says sRGB is known", "[foreign]") {
  CHECK(ColorProfile(rgbProfile(kSrgbPrimaries, 0.0), 3).isSrgb());
  CHECK_FALSE(ColorProfile(rgbProfile(kP3Primaries, 0.0), 3).isSrgb());
  CHECK_FALSE(ColorProfile(greyProfile(1.0), 1).isSrgb());
}

TEST_CASE("color profile: more colours than sRGB has, by the matrix between the primaries", "[foreign]") {
  const ColorProfile profile(rgbProfile(kP3Primaries, 1.0), 3);
  const std::vector<float> p3 = {0.9f, 0.3f, 0.1f};
  for (std::size_t row = 0; row < 3; ++row) {
    double wanted = 0.0;
    for (std::size_t c = 0; c < 3; ++c) wanted += kP3ToSrgb[row][c] * double(p3[c]);
    CHECK_THAT(light(profile, p3)[row], WithinAbs(wanted, 2e-3));
  }
  // Beyond 0..1, as floats may be.
  CHECK_THAT(light(profile, {4.0f, 4.0f, 4.0f})[1], WithinAbs(4.0, 5e-3));
  const float chromaticities[8] = {0.680f, 0.320f, 0.265f, 0.690f, 0.150f, 0.060f, 0.3127f, 0.3290f};
  const ColorProfile same(std::span<const float, 8>(chromaticities), false);
  const ColorProfile encoded(std::span<const float, 8>(chromaticities), true);
  for (std::size_t c = 0; c < 3; ++c) {
    CHECK_THAT(light(same, p3)[c], WithinAbs(light(profile, p3)[c], 1e-4));
    CHECK_THAT(light(encoded, {0.5f, 0.5f, 0.5f})[c], WithinAbs(0.2140, 1e-3));
  }
}

TEST_CASE("color profile: grey and inks", "[foreign]") {
  const ColorProfile grey(greyProfile(1.8), 1);
  for (const float v : {0.1f, 0.5f, 1.0f})
    for (const float value : light(grey, {v})) CHECK_THAT(value, WithinAbs(std::pow(v, 1.8), 2e-3));
  const ColorProfile inks(inkProfile(), 4);
  CHECK_THAT(light(inks, {0, 0, 0, 0})[1], WithinAbs(1.0, 5e-3));
  CHECK_THAT(light(inks, {0, 0, 0, 1})[1], WithinAbs(0.0, 5e-3));
  // L = 50 is a luminance of 0.184.
  for (const float value : light(inks, {0, 0, 0, 0.5f})) CHECK_THAT(value, WithinAbs(0.184, 0.01));
}

TEST_CASE("color profile: damaged ones and those for other pictures are refused", "[foreign]") {
  const Bytes whole = rgbProfile(kP3Primaries, 2.2);
  CHECK_THROWS_WITH(ColorProfile(whole, 1), Contains("is for RGB, and the picture is not"));
  CHECK_THROWS_AS(ColorProfile(Bytes(), 3), Unreadable);
  for (std::size_t size = 0; size < whole.size(); size += 37) {
    try {
      const ColorProfile profile{std::span(whole).first(size), 3};
      CHECK(std::isfinite(light(profile, {0.5f, 0.5f, 0.5f})[0]));
    } catch (const Unreadable& error) {
      CHECK_THAT(error.what(), Contains("damaged"));
    }
  }
  CHECK(profileChannels(whole) == 3);
  CHECK(profileChannels(greyProfile(2.2)) == 1);
  CHECK(profileChannels(inkProfile()) == 4);
  CHECK(profileChannels({}) == 0);
}
