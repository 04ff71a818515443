#include "caches/liquid/connected.h"

#include "numerics/random.h"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace fluidtex;
using fluidtex::caches::Connected;

TEST_CASE("connected: each thing is its own at first, then the lowest of those it is joined to", "[caches]") {
  Connected things(6);
  for (std::uint32_t n = 0; n < 6; ++n) CHECK(things.lowest(n) == n);
  things.join(5, 3);
  things.join(4, 2);
  CHECK(things.lowest(5) == 3);
  CHECK(things.lowest(4) == 2);
  things.join(5, 4);
  for (const std::uint32_t n : {2u, 3u, 4u, 5u}) CHECK(things.lowest(n) == 2);
  things.join(3, 1);
  for (const std::uint32_t n : {1u, 2u, 3u, 4u, 5u}) CHECK(things.lowest(n) == 1);
  things.join(5, 2);  // are already
  things.join(0, 0);
  CHECK(things.lowest(0) == 0);
  CHECK(things.lowest(5) == 1);
}

TEST_CASE("connected: whatever the order of the pairs", "[caches]") {
  constexpr std::uint32_t kCount = 200;
  Connected things(kCount);
  // Labels that are written anew at each pair.
  std::vector<std::uint32_t> label(kCount);
  for (std::uint32_t n = 0; n < kCount; ++n) label[n] = n;
  for (std::uint64_t pair = 0; pair < 150; ++pair) {
    const auto a = std::uint32_t(randomBelow(1, 2 * pair, kCount)),
               b = std::uint32_t(randomBelow(1, 2 * pair + 1, kCount));
    things.join(a, b);
    const std::uint32_t from = std::max(label[a], label[b]), to = std::min(label[a], label[b]);
    std::replace(label.begin(), label.end(), from, to);
  }
  for (std::uint32_t n = 0; n < kCount; ++n) CHECK(things.lowest(n) == label[n]);
}
