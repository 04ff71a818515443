#include "texture/matched_maps.h"

#include "tests/texture/closed_meshes.h"
#include "tests/texture/test_images.h"
#include "texture/orient.h"
#include "texture/synthesize.h"
#include "texture/texel_image.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace fluidtex::texture;
using namespace fluidtex::testing;

namespace {

constexpr int kWidth = 48, kHeight = 40;

double varianceOf(const Image& image) {
  std::vector<double> sum(std::size_t(image.channels)), squares = sum;
  for (std::size_t i = 0; i < image.data.size(); ++i) {
    const double value = image.data[i];
    sum[i % sum.size()] += value, squares[i % sum.size()] += value * value;
  }
  double result = 0.0;
  const double count = double(image.width) * image.height;
  for (std::size_t c = 0; c < sum.size(); ++c)
    result += squares[c] / count - (sum[c] / count) * (sum[c] / count);
  return result;
}

double squaredDifference(const Image& image, std::size_t a, std::size_t b) {
  const auto channels = std::size_t(image.channels);
  double sum = 0.0;
  for (std::size_t c = 0; c < channels; ++c)
    sum += std::pow(image.data[a * channels + c] - image.data[b * channels + c], 2);
  return sum;
}

Image opaque() {
  return blobImage(kWidth, kHeight, 4, 12.0, 2);
}

// The heights of a picture whose colours do not tell them: grain, and blobs below it.
Image grain(int size) {
  return imageOf(size, size, 4, [](int x, int y, int c) {
    return c == 3 ? 1.0f : 0.45f + 0.1f * float(randomUnit(7, std::uint64_t(y * 512 + x)));
  });
}

// Over the joints on a sphere, the mean step of the height shown, in steps between neighbouring texels.
double stepsAtJoints(double weight) {
  constexpr int kSize = 96;
  const Image height = blobImage(kSize, kSize, 1, 16.0, 5);
  SynthesisOptions options;
  options.windows = {17, 9};
  options.firstIterations = {3, 3};
  std::map<std::string, ExemplarMap> maps;
  maps["height"] = {height, MapHolds::values, float(weight)};
  Synthesizer synthesizer =
      makeSynthesizer(makeExemplar(grain(kSize), false, options, 2, {}, {}, std::move(maps)), options);
  Surface surface;
  for (int l = 0; l < 2; ++l) {
    surface.levels.push_back(sphereMesh(24 >> l));
    surface.levels.back().spacing = surface.levels.front().spacing * (1 << l);
  }
  orient(surface, {});
  SynthesisStats stats;
  const TexturedSurface result = synthesize(synthesizer, std::move(surface), {}, 1, 0.0, stats);
  const std::vector<float>& shown = result.maps.at("height");
  double sum = 0.0, joints = 0.0, own = 0.0;
  for (const auto& t : result.triangles)
    for (int i = 0; i < 3; ++i) {
      const auto a = t[i], b = t[(i + 1) % 3];
      if ((result.coordinate[a] - result.coordinate[b]).length() < 3.0f) continue;
      sum += std::abs(shown[a] - shown[b]), joints += 1.0;
    }
  for (int y = 0; y < kSize; ++y)
    for (int x = 1; x < kSize; ++x) own += std::abs(*height.at(x, y) - *height.at(x - 1, y));
  return sum / joints / (own / (double(kSize) * (kSize - 1)));
}

}  // namespace

TEST_CASE("matched maps: a map counts as its weight says, in any unit and resolution") {
  const Image color = opaque();
  const double weight = GENERATE(0.25, 1.0, 4.0);
  const int scale = GENERATE(1, 2);
  const auto height = [](float x, float y) { return 800.0f + 30.0f * std::sin(0.25f * x) + y; };
  const Image metres = imageOf(scale * kWidth, scale * kHeight, 1, [&](int x, int y, int) {
    return height((float(x) + 0.5f) / float(scale), (float(y) + 0.5f) / float(scale));
  });
  const MatchedMaps matched =
      matchedMaps({{"height", {metres, MapHolds::values, float(weight)}}}, color, color, false, 2);
  REQUIRE(matched.image.channels == 1);
  REQUIRE(matched.image.width == kWidth);
  REQUIRE(matched.image.height == kHeight);
  CHECK(matched.kept == 1.0);
  CHECK(varianceOf(matched.image) == Approx(weight * varianceOf(color)).epsilon(1e-3));
  const float* image = matched.image.data.data();
  const auto rise = [&](int x) { return height(float(x) + 0.5f, 0.5f) - height(0.5f, 0.5f); };
  CHECK((image[8] - image[0]) / (image[20] - image[0]) == Approx(rise(8) / rise(20)).epsilon(0.02));
}

TEST_CASE(
    "matched maps: more numbers than channels are reduced, and differences kept as far as they can be") {
  const Image color = opaque();
  const Image height = noiseImage(kWidth, kHeight, 1, 1), albedo = noiseImage(kWidth, kHeight, 3, 2);
  Image depth = height;
  for (float& d : depth.data) d = 3.0f - 2.0f * d;

  std::map<std::string, ExemplarMap> same{{"depth", {depth, MapHolds::values, 0.5f}},
                                          {"height", {height, MapHolds::values, 0.25f}}};
  const MatchedMaps both = matchedMaps(same, color, color, false, 2),
                    one = matchedMaps(same, color, color, false, 1);
  CHECK(both.image.channels == 2);
  REQUIRE(one.image.channels == 1);
  CHECK(one.kept == Approx(1.0));
  for (std::size_t i = 0; i < 100; ++i)
    CHECK(squaredDifference(one.image, i, 17 * i + 5) ==
          Approx(squaredDifference(both.image, i, 17 * i + 5)).margin(1e-5));

  std::map<std::string, ExemplarMap> four = {{"albedo", {albedo, MapHolds::values, 0.5f}},
                                             {"height", {height, MapHolds::values, 0.5f}}};
  const MatchedMaps whole = matchedMaps(four, color, color, false, 4),
                    half = matchedMaps(four, color, color, false, 2);
  CHECK(whole.kept == 1.0);
  CHECK(half.image.channels == 2);
  // Of a half in the height and a sixth in each colour, all independent.
  CHECK(half.kept == Approx(2.0 / 3.0).epsilon(0.05));
  CHECK(varianceOf(half.image) == Approx(half.kept * varianceOf(whole.image)).epsilon(1e-3));
}

TEST_CASE("matched maps: what is not seen does not count, nor what says nothing") {
  Image color = opaque();
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth / 2; ++x) color.at(x, y)[3] = 0.0f;
  const Image height = imageOf(
      kWidth, kHeight, 1, [](int x, int y, int) { return x < kWidth / 2 ? 100.0f : std::sin(float(y)); });
  const MatchedMaps matched =
      matchedMaps({{"height", {height, MapHolds::values, 1.0f}}}, color, color, false, 1);
  REQUIRE(matched.image.channels == 1);
  CHECK(*matched.image.at(3, 3) == 0.0f);
  CHECK(std::abs(*matched.image.at(kWidth - 3, 2)) > 0.1f);

  const Image plain = imageOf(kWidth, kHeight, 1, [](int, int, int) { return 0.3f; });
  CHECK(matchedMaps({{"plain", {plain, MapHolds::values, 1.0f}}}, color, color, false, 1).image.channels ==
        0);
  CHECK(matchedMaps({{"height", {height, MapHolds::values, 0.0f}}}, color, color, false, 1).image.channels ==
        0);
  const Image vectors = noiseImage(kWidth, kHeight, 3, 1);
  CHECK_THROWS_AS(matchedMaps({{"n", {vectors, MapHolds::normals, 1.0f}}}, color, color, false, 1),
                  std::invalid_argument);
}

TEST_CASE("matched maps: they stand between the colours and the found channels, and fill what is free") {
  const auto made = [](bool alpha, bool guided) {
    Image color = opaque();
    if (alpha) color.at(1, 1)[3] = 0.5f;
    std::map<std::string, ExemplarMap> maps;
    for (const char* name : {"a", "b", "c", "d"})
      maps[name] = {noiseImage(kWidth, kHeight, 1, std::uint64_t(name[0])), MapHolds::values, 1.0f};
    SynthesisOptions options;
    return makeExemplar(color, false, options, 2, guided ? noiseImage(kWidth, kHeight, 1, 9) : Image{}, {},
                        maps);
  };
  for (const bool alpha : {false, true})
    for (const bool guided : {false, true}) {
      const Exemplar exemplar = made(alpha, guided);
      CHECK(exemplar.mapChannels == 3 - alpha - guided);
      CHECK(exemplar.match[0].channels == kMaxChannels);
      CHECK(exemplar.match[1].channels == kMaxChannels);
      CHECK(exemplar.mapsKept < 1.0);
      CHECK(exemplar.maps.size() == 4);
    }
}

TEST_CASE("matched maps: heights that colours do not tell go on across joints") {
  const double lookedUp = stepsAtJoints(0.0), matched = stepsAtJoints(1.0);
  INFO(lookedUp << " " << matched);
  CHECK(matched < 2.0);
  CHECK(lookedUp > 2.0 * matched);
}
