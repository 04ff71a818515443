#include "texture/exemplar/matched_maps.h"

#include "tests/texture/exemplar/test_images.h"
#include "tests/texture/mesh/closed_meshes.h"
#include "texture/exemplar/texel_image.h"
#include "texture/frames/synthesize.h"
#include "texture/orientation/orient.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace fluidtex::texture;
using namespace fluidtex::testing;
using fluidtex::randomUnit;

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

Image opaque() {
  return blobImage(kWidth, kHeight, 4, 12.0, 2);
}

// A picture whose colours tell nothing of heights.
Image grain(int size) {
  return imageOf(size, size, 4, [](int x, int y, int c) {
    return c == 3 ? 1.0f : 0.3f + 0.4f * float(randomUnit(7, std::uint64_t(y * 512 + x)));
  });
}

// Over the joints on a sphere, the mean step of the height shown, in steps between neighbouring texels.
double stepsAtJoints(double weight, std::uint64_t seed) {
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
  const TexturedSurface result = synthesize(synthesizer, std::move(surface), {}, seed, 0.0, stats);
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
  const bool toroidal = GENERATE(false, true);
  const double weight = GENERATE(0.25, 1.0, 4.0);
  const float unit = GENERATE(1e-7f, 30.0f);
  const int width = GENERATE(24, 48, 96, 120), height = GENERATE(20, 80);
  const auto relief = [&](float x, float y) { return unit * (25.0f + std::sin(0.25f * x) + 0.05f * y); };
  const Image metres = imageOf(width, height, 1, [&](int x, int y, int) {
    return relief((float(x) + 0.5f) * kWidth / float(width), (float(y) + 0.5f) * kHeight / float(height));
  });
  const MatchedMaps matched =
      matchedMaps({{"height", {metres, MapHolds::values, float(weight)}}}, color, color, toroidal, 2);
  REQUIRE(matched.image.channels == 1);
  REQUIRE(matched.image.width == kWidth);
  REQUIRE(matched.image.height == kHeight);
  CHECK(matched.share == 1.0);
  CHECK(varianceOf(matched.image) == Approx(weight * varianceOf(color)).epsilon(1e-3));
  const auto shown = [&](int x, int y) { return matched.image.at(x, y)[0] - matched.image.at(8, 8)[0]; };
  const auto rise = [&](int x, int y) {
    return relief(float(x) + 0.5f, float(y) + 0.5f) - relief(8.5f, 8.5f);
  };
  for (const auto& [x, y] : {std::pair(12, 8), std::pair(20, 30), std::pair(30, 12)})
    CHECK(shown(x, y) / shown(20, 8) == Approx(rise(x, y) / rise(20, 8)).epsilon(0.03));
}

TEST_CASE("matched maps: where colours hardly differ, a map is measured by a fiftieth") {
  const auto variance = [](float deviation) {
    const Image color = imageOf(kWidth, kHeight, 4, [&](int x, int y, int c) {
      return c == 3 ? 1.0f : 0.5f + ((x + y + c) % 2 == 0 ? deviation : -deviation);
    });
    const Image height = noiseImage(kWidth, kHeight, 1, 1);
    return varianceOf(
        matchedMaps({{"height", {height, MapHolds::values, 1.0f}}}, color, color, false, 1).image);
  };
  CHECK(variance(0.05f) == Approx(3 * 0.05 * 0.05).epsilon(1e-3));
  CHECK(variance(0.02f) == Approx(3 * 0.02 * 0.02).epsilon(1e-3));
  CHECK(variance(0.0f) == Approx(3 * 0.02 * 0.02).epsilon(1e-3));
}

TEST_CASE(
    "matched maps: what says the same takes one channel, what is too much is reduced to what differs most") {
  const Image color = opaque();
  const Image height = noiseImage(kWidth, kHeight, 1, 1), albedo = noiseImage(kWidth, kHeight, 3, 2);
  Image depth = height;
  for (float& d : depth.data) d = 3.0f - 2.0f * d;
  const Image grey = imageOf(kWidth, kHeight, 3, [&](int x, int y, int) { return height.at(x, y)[0]; });

  for (const std::map<std::string, ExemplarMap>& same :
       {std::map<std::string, ExemplarMap>{{"height", {height, MapHolds::values, 0.75f}}},
        std::map<std::string, ExemplarMap>{{"depth", {depth, MapHolds::values, 0.5f}},
                                           {"height", {height, MapHolds::values, 0.25f}}},
        std::map<std::string, ExemplarMap>{{"grey", {grey, MapHolds::values, 0.75f}}}}) {
    const MatchedMaps matched = matchedMaps(same, color, color, false, 3);
    REQUIRE(matched.image.channels == 1);
    CHECK(matched.share == Approx(1.0));
    CHECK(varianceOf(matched.image) == Approx(0.75 * varianceOf(color)).epsilon(1e-3));
    const float whole = matched.image.data[50] - matched.image.data[0];
    for (const std::size_t i : {7u, 100u, 1000u})
      CHECK((matched.image.data[i] - matched.image.data[0]) / whole ==
            Approx((height.data[i] - height.data[0]) / (height.data[50] - height.data[0])).margin(1e-3));
  }

  const std::map<std::string, ExemplarMap> four = {{"albedo", {albedo, MapHolds::values, 0.5f}},
                                                   {"height", {height, MapHolds::values, 0.5f}}};
  const MatchedMaps whole = matchedMaps(four, color, color, false, 4),
                    halved = matchedMaps(four, color, color, false, 2);
  CHECK(whole.share == Approx(1.0));
  CHECK(whole.image.channels == 4);
  CHECK(halved.image.channels == 2);
  // Of a half in the height and a sixth in each colour, all independent.
  CHECK(halved.share == Approx(2.0 / 3.0).epsilon(0.05));
  CHECK(varianceOf(halved.image) == Approx(halved.share * varianceOf(whole.image)).epsilon(1e-3));
}

TEST_CASE("matched maps: what is not seen does not count, nor what says nothing") {
  Image color = opaque();
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth / 2; ++x) color.at(x, y)[3] = 0.0f;
  const auto matched = [&](float hidden) {
    const Image height = imageOf(kWidth, kHeight, 1, [&](int x, int y, int) {
      return x < kWidth / 2 ? hidden : 5.0f + std::sin(float(y));
    });
    return matchedMaps({{"height", {height, MapHolds::values, 1.0f}}}, color, color, false, 1).image;
  };
  const Image image = matched(100.0f);
  REQUIRE(image.channels == 1);
  CHECK(image.data == matched(-7.0f).data);
  CHECK(*image.at(3, 3) == 0.0f);
  double sum = 0.0;
  for (const float value : image.data) sum += value;
  CHECK(sum / double(image.data.size()) == Approx(0.0).margin(1e-5));
  CHECK(varianceOf(image) == Approx(varianceOf(color)).epsilon(1e-3));

  const Image plain = imageOf(kWidth, kHeight, 1, [](int, int, int) { return 0.3f; });
  const Image height = noiseImage(kWidth, kHeight, 1, 1), vectors = noiseImage(kWidth, kHeight, 3, 1);
  const auto channels = [&](const Image& map, MapHolds holds, float weight) {
    return matchedMaps({{"map", {map, holds, weight}}}, color, color, false, 1).image.channels;
  };
  CHECK(channels(plain, MapHolds::values, 1.0f) == 0);
  CHECK(channels(height, MapHolds::values, 0.0f) == 0);
  CHECK(channels(height, MapHolds::values, 1.0f) == 1);
  CHECK(channels(vectors, MapHolds::normals, 0.0f) == 0);
  CHECK_THROWS_AS(channels(vectors, MapHolds::normals, 1.0f), std::invalid_argument);
  CHECK_THROWS_AS(channels({}, MapHolds::values, 1.0f), std::invalid_argument);
}

TEST_CASE("matched maps: they stand between the colours and the found channels, and fill what is free") {
  const bool alpha = GENERATE(false, true), guided = GENERATE(false, true);
  Image color = opaque();
  if (alpha) color.at(1, 1)[3] = 0.5f;
  const Image guidance = guided ? noiseImage(kWidth, kHeight, 1, 9) : Image{};
  std::map<std::string, ExemplarMap> maps;
  for (const char* name : {"a", "b", "c", "d"})
    maps[name] = {noiseImage(kWidth, kHeight, 1, std::uint64_t(name[0])), MapHolds::values, 1.0f};
  SynthesisOptions options;
  const Exemplar plain = makeExemplar(color, false, options, 2, guidance),
                 exemplar = makeExemplar(color, false, options, 2, guidance, {}, maps);
  CHECK(exemplar.mapChannels == 3 - alpha - guided);
  CHECK(exemplar.mapShare < 1.0);
  CHECK(exemplar.maps.size() == 4);
  const std::size_t before = std::size_t(3 + alpha + guided), own = std::size_t(exemplar.mapChannels);
  for (const std::size_t level : {0u, 1u}) {
    const Image &with = exemplar.match[level], &without = plain.match[level];
    REQUIRE(with.channels == kMaxChannels);
    REQUIRE(without.channels == kMaxChannels - exemplar.mapChannels);
    for (const auto& [x, y] : {std::pair(1, 1), std::pair(7, 13)}) {
      for (std::size_t c = 0; c < before; ++c) CHECK(with.at(x, y)[c] == without.at(x, y)[c]);
      for (std::size_t c = before; c < before + 2; ++c) CHECK(with.at(x, y)[c + own] == without.at(x, y)[c]);
    }
  }

  options.method = Method::kwatra07;  // carries colours, which have no maps beside them
  const Exemplar paper = makeExemplar(color, false, options, 2, guidance, {}, maps);
  CHECK(paper.mapChannels == 0);
  CHECK(paper.match[0].data == plain.match[0].data);
}

TEST_CASE("matched maps: heights that colours do not tell go on across joints") {
  // One seed differs from another by a fifth.
  double lookedUp = 0.0, matched = 0.0;
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    lookedUp += 0.25 * stepsAtJoints(0.0, seed);
    matched += 0.25 * stepsAtJoints(1.0, seed);
  }
  INFO(lookedUp << " " << matched);
  CHECK(matched < 2.6);
  CHECK(lookedUp > 1.8 * matched);
}
