#include "numerics/random.h"

#include <catch2/catch.hpp>

#include <array>
#include <bit>
#include <cmath>
#include <set>
#include <vector>

using namespace fluidtex;

TEST_CASE("random: streams of different seeds share nothing, shifted or not", "[random]") {
  constexpr std::uint64_t kCount = 2000;
  std::set<std::uint64_t> seen;
  std::size_t drawn = 0;
  for (const std::uint64_t seed : {0ull, 1ull, 2ull, 3ull, 7ull, 1ull << 32, ~0ull})
    for (std::uint64_t n = 0; n < kCount; ++n, ++drawn) seen.insert(randomBits(seed, n));
  CHECK(seen.size() == drawn);
  // Nor the same differences, by sum or by exclusive or: then one would be the other moved by a constant.
  std::set<std::uint64_t> differences, exclusive;
  for (const std::uint64_t seed : {1ull, 2ull, 3ull})
    for (std::uint64_t n = 0; n < kCount; ++n) {
      differences.insert(randomBits(seed, n + 1) - randomBits(seed, n));
      exclusive.insert(randomBits(seed, n) ^ randomBits(seed, n ^ 1));
    }
  CHECK(differences.size() == 3 * kCount);
  CHECK(exclusive.size() == 3 * kCount / 2);
}

TEST_CASE("random: each use of the scene's seed has a stream of its own", "[random]") {
  std::set<std::uint64_t> seeds;
  for (std::uint64_t seed = 0; seed < 100; ++seed)
    for (const Stream purpose : {Stream::markers, Stream::points, Stream::orientation, Stream::windows,
                                 Stream::synthesis, Stream::renewal})
      seeds.insert(streamOf(seed, purpose));
  CHECK(seeds.size() == 600);
}

TEST_CASE("random: every bit is 1 half of the time, whichever bit of seed or counter changes", "[random]") {
  constexpr int kCount = 4000;
  // Six deviations of a mean of so many coins.
  const double most = 6.0 * 0.5 / std::sqrt(double(kCount));
  std::array<int, 64> ones{};
  for (std::uint64_t n = 0; n < kCount; ++n)
    for (std::size_t bit = 0; bit < 64; ++bit) ones[bit] += int(randomBits(5, n) >> bit & 1u);
  for (const int count : ones) CHECK(std::abs(double(count) / kCount - 0.5) < most);

  for (std::size_t flipped = 0; flipped < 64; ++flipped) {
    double bySeed = 0.0, byCounter = 0.0;
    constexpr int kTries = 200;
    for (std::uint64_t n = 0; n < kTries; ++n) {
      const std::uint64_t bit = std::uint64_t(1) << flipped;
      bySeed += std::popcount(randomBits(n, 3) ^ randomBits(n ^ bit, 3));
      byCounter += std::popcount(randomBits(3, n) ^ randomBits(3, n ^ bit));
    }
    CHECK(std::abs(bySeed / kTries - 32.0) < 6.0 * 4.0 / std::sqrt(double(kTries)));
    CHECK(std::abs(byCounter / kTries - 32.0) < 6.0 * 4.0 / std::sqrt(double(kTries)));
  }
}

TEST_CASE("random: seeds side by side are not alike at the same counter", "[random]") {
  constexpr int kCount = 20000;
  double product = 0.0;
  for (std::uint64_t n = 0; n < kCount; ++n) product += (randomUnit(1, n) - 0.5) * (randomUnit(2, n) - 0.5);
  CHECK(std::abs(product / kCount) < 6.0 / 12.0 / std::sqrt(double(kCount)));
}

TEST_CASE("random: numbers below n are even", "[random]") {
  std::array<int, 7> count{};
  for (std::uint64_t n = 0; n < 7000; ++n) ++count[randomBelow(9, n, 7)];
  for (const int c : count) CHECK(std::abs(c - 1000) < 6 * 30);
  for (std::uint64_t n = 0; n < 1000; ++n) CHECK(randomUnit(4, n) < 1.0);
}
