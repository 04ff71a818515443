#include "texture/exemplar/exemplar.h"

#include "tests/texture/exemplar/sample_images.h"
#include "texture/exemplar/channels.h"
#include "texture/exemplar/srgb.h"

#include <catch2/catch.hpp>

#include <numeric>

using namespace fluidtex::texture;
using namespace fluidtex::testing;
using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;

namespace {

std::vector<float> channelOf(const Image& image, int channel) {
  std::vector<float> values;
  for (std::size_t i = std::size_t(channel); i < image.data.size(); i += std::size_t(image.channels))
    values.push_back(image.data[i]);
  return values;
}

double meanOf(const std::vector<float>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
}

Image withAlpha(Image image) {
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) image.at(x, y)[3] = 0.5f + 0.5f * std::sin(0.2f * float(x + 2 * y));
  return image;
}

// The message of the refusal, empty where there is none.
std::string refusal(const Image& image, const SynthesisOptions& options = {}) {
  try {
    makeExemplar(image, false, options, 3);
  } catch (const ExemplarError& error) {
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("exemplar: levels halve, and hold the channels asked for", "[texture]") {
  const Image image = paint(101, 64, [](float x, float y, float* c) {
    c[0] = c[1] = c[2] = smoothNoise(x, y, 128, 16, 1), c[3] = 1.0f;
  });
  const Exemplar exemplar = makeExemplar(image, false, {}, 3);
  REQUIRE(exemplar.match.size() == 3);
  CHECK(exemplar.color.data == image.data);
  const int sizes[3][2] = {{101, 64}, {51, 32}, {26, 16}};
  for (std::size_t level = 0; level < 3; ++level) {
    CHECK(exemplar.match[level].width == sizes[level][0]);
    CHECK(exemplar.match[level].height == sizes[level][1]);
    CHECK(exemplar.match[level].channels == 5);
    CHECK(exemplar.match[level].data.size() == std::size_t(sizes[level][0] * sizes[level][1] * 5));
  }
  CHECK(exemplar.colorChannels == 3);
  CHECK(makeExemplar(withAlpha(image), false, {}, 1).colorChannels == 4);
  CHECK(makeExemplar(withAlpha(image), false, {}, 1).match[0].channels == 6);
  SynthesisOptions plain;
  plain.featureWeight = 0.0;
  CHECK(makeExemplar(image, false, plain, 1).match[0].channels == 4);
  plain.gradientWeight = 0.0;
  CHECK(makeExemplar(image, false, plain, 1).match[0].channels == 3);
  CHECK(makeExemplar(image, false, plain, 0).match.size() == 1);
}

TEST_CASE("exemplar: full size holds encoded premultiplied colours and weighted channels", "[texture]") {
  const Image image = withAlpha(cells(64));
  SynthesisOptions options;
  options.featureWeight = 0.09;
  options.gradientWeight = 0.25;
  const Exemplar exemplar = makeExemplar(image, true, options, 1);
  const Image& match = exemplar.match[0];
  Image encoded{64, 64, 4, {}};
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      const float* in = image.at(x, y);
      for (int c = 0; c < 3; ++c) {
        CHECK_THAT(match.at(x, y)[c], WithinAbs(encodeSrgb(in[c] * in[3]), 1e-6));
        encoded.data.push_back(match.at(x, y)[c]);
      }
      CHECK(match.at(x, y)[3] == in[3]);
      encoded.data.push_back(in[3]);
    }
  const Image luminance = featureLuminance(encoded);
  std::vector<float> feature = featureDistance(luminance, true).data,
                     gradient = gradientEnergy(luminance, true).data;
  for (float& value : feature) value *= 0.3f;
  for (float& value : gradient) value *= 0.5f;
  CHECK(largestDifference(channelOf(match, 4), feature) < 1e-6f);
  CHECK(largestDifference(channelOf(match, 5), gradient) < 1e-6f);
}

TEST_CASE("exemplar: levels keep the mean light, and the mean of the channels", "[texture]") {
  for (const bool alpha : {false, true}) {
    const Image image = alpha ? withAlpha(clouds(64)) : clouds(64);
    const Exemplar exemplar = makeExemplar(image, true, {}, 4);
    for (int c = 0; c < exemplar.match[0].channels; ++c) {
      // Light is meant: colours are decoded first.
      const bool color = c < 3;
      const auto light = [&](const Image& level) {
        std::vector<float> values = channelOf(level, c);
        if (color)
          for (float& value : values) value = decodeSrgb(value);
        return meanOf(values);
      };
      for (std::size_t level = 1; level < 4; ++level)
        CHECK_THAT(light(exemplar.match[level]), WithinAbs(light(exemplar.match[0]), 1e-5));
    }
  }
}

TEST_CASE("exemplar: colours where alpha is zero do not show", "[texture]") {
  Image a = withAlpha(cells(64));
  for (int x = 10; x < 30; ++x) a.at(x, 20)[3] = 0.0f;
  Image b = a;
  for (int x = 10; x < 30; ++x) b.at(x, 20)[0] = 900.0f;
  const Exemplar first = makeExemplar(a, false, {}, 3), second = makeExemplar(b, false, {}, 3);
  for (std::size_t level = 0; level < 3; ++level) CHECK(first.match[level].data == second.match[level].data);
}

TEST_CASE("exemplar: what cannot be used is refused in one sentence", "[texture]") {
  Image clear = cells(64), broken = cells(64);
  for (std::size_t i = 3; i < clear.data.size(); i += 4) clear.data[i] = 0.0f;
  broken.data[77] = std::numeric_limits<float>::quiet_NaN();
  CHECK_THAT(refusal(clear), Contains("transparent"));
  CHECK_THAT(refusal(broken), Contains("not finite"));
  const Image narrow = paint(200, 20, [](float, float, float* c) { std::fill_n(c, 4, 1.0f); });
  CHECK_THAT(refusal(narrow), Contains("200 x 20") && Contains("33 x 33"));
  SynthesisOptions small;
  small.windows = {17, 9};
  CHECK(refusal(narrow, small).empty());
  CHECK(refusal(cells(64)).empty());
  // Windows of three pixels need a choice of places.
  small.windows = {3};
  const Image four = paint(9, 4, [](float x, float, float* c) { std::fill_n(c, 4, 0.2f + 0.05f * x); });
  const Image five = paint(9, 5, [](float x, float, float* c) { std::fill_n(c, 4, 0.2f + 0.05f * x); });
  CHECK_THAT(refusal(four, small), Contains("9 x 4") && Contains("5 x 5"));
  CHECK(refusal(five, small).empty());
  CHECK(makeExemplar(four, true, small, 1).match.size() == 1);
  CHECK_THROWS_AS(makeExemplar(Image{40, 40, 3, std::vector<float>(4800)}, false, {}, 1),
                  std::invalid_argument);
}
