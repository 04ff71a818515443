#include "texture/search/pca.h"

#include "tests/texture/search/sample_windows.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex::texture;
using namespace fluidtex::testing;
using Catch::Matchers::WithinAbs;

TEST_CASE("pca: the components are orthonormal under the fall-off", "[texture]") {
  const Exemplar exemplar = makeExemplar(cells(64), false, {}, 1);
  for (const int window : {9, 17}) {
    const WindowBasis basis = buildSearchTable(exemplar.match[0], false, window, 1).basis;
    const std::vector<float> falloff = buildSearchTable(exemplar.match[0], false, window, 1).falloff;
    for (int a = 0; a < kDescriptorSize; ++a)
      for (int b = 0; b <= a; ++b) {
        double product = 0.0;
        for (int i = 0; i < basis.size; ++i)
          product += double(basis.component[std::size_t(i * kDescriptorSize + a)]) *
                     basis.component[std::size_t(i * kDescriptorSize + b)] /
                     falloff[std::size_t(i / exemplar.match[0].channels)];
        CHECK_THAT(product, WithinAbs(a == b ? 1.0 : 0.0, 1e-4));
      }
  }
}

TEST_CASE("pca: descriptors are no farther apart than their windows, and as far where 24 components suffice",
          "[texture]") {
  // Six waves in one channel: the windows span a constant and twelve waves, sine and cosine.
  Image waves{64, 64, 1, {}};
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      float value = 0.5f;
      for (int k = 1; k <= 6; ++k)
        value += 0.08f * std::sin(2.0f * float(M_PI) * float(k * x + (7 - k) * y) / 64.0f + float(k));
      waves.data.push_back(value);
    }
  const Exemplar cellular = makeExemplar(cells(64), true, {}, 1);
  for (const Image* image : {static_cast<const Image*>(&waves), &cellular.match[0]}) {
    const SearchTable table = buildSearchTable(*image, true, 9, 3);
    WindowQuery a(table), b(table);
    for (std::uint64_t n = 0; n < 50; ++n) {
      const Vec2i first = randomCenter(table, 1, n), second = randomCenter(table, 2, n);
      readWindow(table, *image, first, a);
      readWindow(table, *image, second, b);
      const auto from = describeQuery(table, a), to = describeQuery(table, b);
      double between = 0.0;
      for (std::size_t k = 0; k < from.size(); ++k) between += std::pow(double(from[k]) - to[k], 2);
      const float distance = windowDistance(table, a, second);
      CHECK(between <= distance * 1.001 + 1e-6);
      if (image == &waves) CHECK_THAT(between, WithinAbs(distance, 1e-3 * distance + 1e-5));
    }
  }
}

TEST_CASE("pca: all descriptors at once are those of the windows one by one, and come back from them",
          "[texture]") {
  const Exemplar exemplar = makeExemplar(stripes(64), true, {}, 1);
  const SearchTable table = buildSearchTable(exemplar.match[0], true, 9, 1);
  const std::vector<float> all = describeAll(table.basis, table.padded, 9, 3, 20, 21);
  WindowQuery query(table);
  for (const Vec2i at : {Vec2i(0, 0), Vec2i(19, 20), Vec2i(7, 3)}) {
    readWindow(table, exemplar.match[0], at * 3, query);
    const auto descriptor = describeQuery(table, query);
    for (std::size_t k = 0; k < descriptor.size(); ++k)
      CHECK_THAT(all[std::size_t(at[1] * 20 + at[0]) * kDescriptorSize + k], WithinAbs(descriptor[k], 1e-4));
    // Describing what a descriptor stands for gives the descriptor.
    std::vector<float> pixels(query.pixels.size()), again(kDescriptorSize);
    reconstructWindow(table.basis, table.falloff, descriptor, pixels);
    describeWindow(table.basis, pixels, again);
    for (std::size_t k = 0; k < again.size(); ++k) CHECK_THAT(again[k], WithinAbs(descriptor[k], 1e-4));
  }
}
