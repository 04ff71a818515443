#include "texture/search/window_codes.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using namespace fluidtex::texture;

namespace {

// Components of falling size, as principal components have.
std::vector<float> descriptors(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> normal;
  std::vector<float> values;
  for (std::size_t n = 0; n < count; ++n)
    for (int k = 0; k < kDescriptorSize; ++k) values.push_back(normal(random) / float(1 + k));
  return values;
}

}  // namespace

TEST_CASE("window codes: distances are right to the step of the codes") {
  constexpr std::size_t kCount = 4 * kCodeBlock;
  const std::vector<float> windows = descriptors(kCount, 1), queries = descriptors(8, 2);
  WindowCodes codes = codesFor(windows);
  for (std::size_t n = 0; n < kCount; ++n) addCode(codes, windows.data() + n * kDescriptorSize);
  makeCoarse(codes);
  REQUIRE(codes.count() == kCount);
  for (std::size_t q = 0; q < 8; ++q) {
    const float* descriptor = queries.data() + q * kDescriptorSize;
    const CodedQuery query(codes, descriptor);
    for (std::size_t n = 0; n < kCount; ++n) {
      double exact = 0.0;
      int coarse = 0;
      for (int k = 0; k < kDescriptorSize; ++k) {
        const double difference = windows[n * kDescriptorSize + std::size_t(k)] - descriptor[k];
        exact += difference * difference;
        const int upper = (codes.fine[n * kDescriptorSize + std::size_t(k)] >> 8) - (query.fine[k] >> 8);
        coarse += upper * upper;
      }
      // Each component by a step at most.
      CHECK(std::abs(std::sqrt(fineDistance(codes, n, query)) - std::sqrt(exact)) <=
            1.01 * codes.step * std::sqrt(double(kDescriptorSize)));
      CHECK(coarseDistances(codes, n / kCodeBlock, query)[n % kCodeBlock] == std::min(coarse, 32767));
    }
  }
}

TEST_CASE("window codes: what lies outside the range is clamped to it") {
  const std::vector<float> windows = descriptors(kCodeBlock, 3);
  const WindowCodes codes = codesFor(windows);
  const std::vector<float> far(kDescriptorSize, 1e9f), low(kDescriptorSize, -1e9f),
      none(kDescriptorSize, NAN);
  for (const std::int16_t code : CodedQuery(codes, far.data()).fine) CHECK(code == 32767);
  for (const std::int16_t code : CodedQuery(codes, low.data()).fine) CHECK(code == 0);
  for (const std::int16_t code : CodedQuery(codes, none.data()).fine) CHECK(code == 0);
}
