#include "tools/benchmarks/peers/window_search.h"

#include "numerics/random.h"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace fluidtex;
using namespace fluidtex::benchmarks;

namespace {

constexpr std::size_t kSize = texture::kDescriptorSize;

// Windows at random in a cube, and queries among them.
SearchProblem randomProblem(std::size_t windows, std::size_t queries) {
  SearchProblem problem;
  problem.count = 3;
  for (std::uint64_t i = 0; i < windows * kSize; ++i) problem.windows.push_back(float(randomUnit(1, i)));
  for (std::uint64_t i = 0; i < queries * kSize; ++i) problem.queries.push_back(float(randomUnit(2, i)));
  return problem;
}

// What comparing each query with every window finds.
SearchRun compared(const SearchProblem& problem) {
  SearchRun run;
  for (std::size_t q = 0; q < problem.size(); ++q) {
    std::vector<double> squares;
    for (std::size_t w = 0; w < problem.windows.size() / kSize; ++w) {
      double square = 0.0;
      for (std::size_t k = 0; k < kSize; ++k) {
        const double d = double(problem.windows[w * kSize + k]) - double(problem.queries[q * kSize + k]);
        square += d * d;
      }
      squares.push_back(square);
    }
    std::sort(squares.begin(), squares.end());
    run.nearest += squares[0] / double(problem.size());
    for (int k = 0; k < problem.count; ++k)
      run.all += squares[std::size_t(k)] / double(problem.size()) / problem.count;
  }
  return run;
}

}  // namespace

TEST_CASE("search peers: as many queries as there are descriptors of them", "[benchmarks]") {
  CHECK(SearchProblem{}.size() == 0);
  CHECK(randomProblem(2, 5).size() == 5);
}

TEST_CASE("search peers: by comparing all, the nearest windows are found", "[benchmarks]") {
  const SearchProblem problem = randomProblem(2000, 50);
  const std::vector<SearchRun> runs = searchFaiss(problem, PeerIndex::flat, 0.0);
  if (runs.empty()) {
    WARN("libfaiss is not there");
    return;
  }
  const SearchRun exact = compared(problem);
  REQUIRE(runs.size() == 1);
  CHECK(runs[0].nearest == Approx(exact.nearest).epsilon(1e-4));
  CHECK(runs[0].all == Approx(exact.all).epsilon(1e-4));
  CHECK(runs[0].seconds > 0.0);
}

TEST_CASE("search peers: effort rises until the nearest windows are near enough", "[benchmarks]") {
  const SearchProblem problem = randomProblem(1000, 30);
  const double exact = compared(problem).nearest;
  const auto enough = searchFaiss(problem, PeerIndex::hnsw, 1.5 * exact);
  if (enough.empty()) {
    WARN("libfaiss is not there");
    return;
  }
  for (const SearchRun& run : enough) {
    CHECK(run.nearest >= exact * (1.0 - 1e-4));
    CHECK(run.all >= run.nearest);
  }
  CHECK(enough.back().nearest <= 1.5 * exact);
  // Nothing is as near as that: all settings are tried, each with its name.
  const auto most = searchFaiss(problem, PeerIndex::hnsw, 0.0);
  CHECK(most.size() > enough.size());
  CHECK(most.back().nearest == Approx(exact).epsilon(0.02));
  CHECK(most.front().setting != most.back().setting);
}
