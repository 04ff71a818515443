#include "texture/loops/parallel.h"

#include "tests/threads.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex::texture;

TEST_CASE("parallel: every index once, sums right and the same on any number of threads") {
  for (const std::size_t count : {std::size_t(0), std::size_t(1), std::size_t(511), std::size_t(100000)}) {
    std::vector<int> calls(count, 0);
    forEachIndex(count, [&](std::uint32_t i) { ++calls[i]; });
    CHECK(calls == std::vector<int>(count, 1));
    const auto term = [](std::uint32_t i) { return 1.0 / (1.0 + i); };
    double sum = 0.0, serial = 0.0;
    for (std::size_t i = 0; i < count; ++i) serial += term(std::uint32_t(i));
    sum = sumOf(count, term);
    CHECK(sum == Approx(serial).margin(1e-12));
    for (const int threads : {1, 2, 5}) onThreads(threads, [&] { CHECK(sumOf(count, term) == sum); });
  }
}

TEST_CASE("parallel: what is gathered comes in the order of the indices") {
  const auto multiples = [](std::uint32_t i, std::vector<std::uint32_t>& list) {
    for (std::uint32_t n = 0; n < i % 3; ++n) list.push_back(10 * i + n);
  };
  std::vector<std::uint32_t> expected;
  for (std::uint32_t i = 0; i < 10000; ++i) multiples(i, expected);
  CHECK(gathered<std::uint32_t>(10000, multiples) == expected);
  CHECK(gathered<std::uint32_t>(10000, multiples, 7) == expected);
  CHECK(gathered<std::uint32_t>(0, multiples).empty());
}
