#include "tools/report/evenly.h"

#include <catch2/catch.hpp>

#include <numeric>

using namespace fluidtex::tools;

TEST_CASE("report: frames are chosen evenly, with the first and the last", "[tools]") {
  std::vector<int> frames(72);
  std::iota(frames.begin(), frames.end(), 1);
  CHECK(evenly({}, 5).empty());
  CHECK(evenly({3, 4}, 2) == std::vector{3, 4});
  CHECK(evenly({1, 2, 3}, 1) == std::vector{2});
  CHECK(evenly(frames, 2) == std::vector{1, 72});
  const std::vector<int> chosen = evenly(frames, 12);
  REQUIRE(chosen.size() == 12);
  CHECK(chosen.front() == 1);
  CHECK(chosen.back() == 72);
  for (std::size_t n = 1; n < chosen.size(); ++n) {
    CHECK(chosen[n] - chosen[n - 1] >= 6);
    CHECK(chosen[n] - chosen[n - 1] <= 7);
  }
}

TEST_CASE("evenly: none twice, in their order, each the nearest to its even place", "[tools]") {
  for (std::size_t count = 2; count < 40; ++count) {
    std::vector<int> frames(count);
    std::iota(frames.begin(), frames.end(), 100);
    for (std::size_t most = 2; most < count; ++most) {
      const std::vector<int> chosen = evenly(frames, most);
      REQUIRE(chosen.size() == most);
      CHECK(chosen.front() == 100);
      CHECK(chosen.back() == 99 + int(count));
      const double step = double(count - 1) / double(most - 1);
      for (std::size_t n = 0; n < most; ++n) CHECK(std::abs(chosen[n] - 100 - step * double(n)) < 0.5 + 1e-9);
      for (std::size_t n = 1; n < most; ++n) CHECK(chosen[n] > chosen[n - 1]);
    }
  }
  CHECK(evenly({5, 9, 20, 21}, 1) == std::vector{20});
  CHECK(evenly({1, 2, 3}, 0).empty());
}
