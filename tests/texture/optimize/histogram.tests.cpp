#include "texture/optimize/histogram.h"

#include "tests/texture/exemplar/test_images.h"

#include <catch2/catch.hpp>

#include <limits>
#include <numeric>

using namespace fluidtex::texture;
using namespace fluidtex::testing;
using fluidtex::Float8;
using fluidtex::randomUnit;

namespace {

Values texels(const TexelImage& image) {
  Values values;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) values.push_back(image.sampleInside(float(x), float(y)));
  return values;
}

}  // namespace

TEST_CASE("histogram: shares sum to one and count what is there") {
  const TexelImage image = makeTexelImage(
      imageOf(64, 48, 2, [](int x, int y, int c) { return c == 0 ? float(x) : float(y % 2); }), false, 3);
  const HistogramTarget target = makeHistogramTarget(image);
  for (int b = 0; b < kHistogramBins; ++b) {
    CHECK(target.exemplar.share[0][b] == Approx(1.0 / 16));  // 64 columns: four a bin
    CHECK(target.exemplar.share[1][b] == Approx(b == 0 || b == 15 ? 0.5 : 0.0));
  }
  const Histogram own = histogramOf(target, texels(image), image.channels);
  CHECK(own.share == target.exemplar.share);
}

TEST_CASE("histogram: a surface with the exemplar's own shares weighs all texels alike") {
  const TexelImage image = makeTexelImage(blobImage(50, 40, 3, 8.0, 1), false, 3);
  const HistogramTarget target = makeHistogramTarget(image);
  const HistogramWeights weights(target, target.exemplar, histogramOf(target, texels(image), 3), image, 3.0,
                                 0);
  for (std::size_t i = 0; i < image.data.size(); ++i) CHECK(weights[i] == Approx(1.0f).margin(1e-4));
}

TEST_CASE("histogram: what the surface has too much of weighs less, in proportion to the strength") {
  const TexelImage image =
      makeTexelImage(imageOf(64, 4, 1, [](int x, int, int) { return float(x) / 63.0f; }), false, 3);
  const HistogramTarget target = makeHistogramTarget(image);
  Values dark = texels(image);
  for (Float8& value : dark) value[0] *= 0.5f;  // the darker half twice, the brighter not at all
  const Histogram surface = histogramOf(target, dark, 1);
  for (const double strength : {1.0, 3.0}) {
    const HistogramWeights weights(target, target.exemplar, surface, image, strength, 0);
    CHECK(weights[image.nearest(2, 1)] == Approx(1.0 / (1.0 + strength)).epsilon(0.1));
    CHECK(weights[image.nearest(60, 1)] == 1.0f);
    // The same beforehand.
    const HistogramWeights all(target, target.exemplar, surface, image, strength, 1u << 20);
    for (std::size_t i = 0; i < image.data.size(); ++i) CHECK(all[i] == weights[i]);
  }
  const HistogramWeights none(target, target.exemplar, surface, image, 0.0, 0);
  for (std::size_t i = 0; i < image.data.size(); ++i) CHECK(none[i] == 1.0f);
}

TEST_CASE("histogram: what is no number is in a bin, too") {
  const TexelImage image =
      makeTexelImage(imageOf(64, 4, 1, [](int x, int, int) { return float(x) / 63.0f; }), false, 3);
  Values values = texels(image);
  for (Float8& value : values) value[0] = std::numeric_limits<float>::quiet_NaN();
  const Histogram surface = histogramOf(makeHistogramTarget(image), values, 1);
  CHECK(std::accumulate(surface.share[0].begin(), surface.share[0].end(), 0.0f) == Approx(1.0));
}

TEST_CASE("histogram: a plain image is no trouble") {
  const TexelImage image = makeTexelImage(imageOf(20, 20, 3, [](int, int, int) { return 0.4f; }), false, 3);
  const HistogramTarget target = makeHistogramTarget(image);
  const HistogramWeights weights(target, target.exemplar, histogramOf(target, texels(image), 3), image, 3.0,
                                 0);
  for (std::size_t i = 0; i < image.data.size(); ++i) CHECK(weights[i] == 1.0f);
}

TEST_CASE("histogram: a matched map counts by its share of the differences, at most as a colour") {
  const auto counts = [](float amplitude) {
    const Image picture = imageOf(32, 32, 4, [&](int x, int y, int c) {
      const auto value = float(randomUnit(std::uint64_t(c) + 1, std::uint64_t(y * 32 + x)));
      return c == 3 ? amplitude * value : value;
    });
    TexelImage image = makeTexelImage(picture, false, 4);
    image.firstMap = 3, image.maps = 1;
    return makeHistogramTarget(image).counts;
  };
  CHECK(counts(0.1f)[3] == Approx(0.01).epsilon(0.1));
  CHECK(counts(1e-4f)[3] < 1e-6f);
  CHECK(counts(2.0f)[3] == 1.0f);
  CHECK(counts(0.1f)[2] == 1.0f);
}
