#include "texture/labels/min_cut.h"

#include "numerics/random.h"

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/push_relabel_max_flow.hpp>
#include <catch2/catch.hpp>

#include <limits>
#include <vector>

using namespace fluidtex::texture;
using fluidtex::randomUnit;

namespace {

struct Pair {
  std::uint32_t i, j;
  float keepTake, takeKeep;
};

// A binary problem with whole-numbered costs, so that sums are exact in any order.
struct Problem {
  std::vector<float> keep, take;
  std::vector<Pair> pairs;

  double cost(const std::vector<bool>& takes) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < keep.size(); ++i) sum += double(takes[i] ? take[i] : keep[i]);
    for (const Pair& p : pairs)
      if (takes[p.i] != takes[p.j]) sum += double(takes[p.i] ? p.takeKeep : p.keepTake);
    return sum;
  }
};

Problem randomProblem(std::size_t nodes, std::size_t pairs, std::uint64_t seed) {
  const auto random = [&](std::uint64_t i, double range) {
    return float(std::floor(range * randomUnit(seed, i)));
  };
  Problem problem;
  for (std::size_t i = 0; i < nodes; ++i) {
    problem.keep.push_back(random(2 * i, 20));
    problem.take.push_back(random(2 * i + 1, 20));
  }
  for (std::size_t k = 0; k < pairs; ++k) {
    const std::uint64_t key = 2 * nodes + 4 * k;
    const auto i = std::uint32_t(random(key, double(nodes))),
               j = std::uint32_t(random(key + 1, double(nodes)));
    if (i != j) problem.pairs.push_back({i, j, random(key + 2, 8), random(key + 3, 8)});
  }
  return problem;
}

// A grid, as a piece of a surface is: neighbours in both directions.
Problem gridProblem(std::uint32_t side, std::uint64_t seed) {
  Problem problem = randomProblem(std::size_t(side) * side, 0, seed);
  for (std::uint32_t y = 0; y < side; ++y)
    for (std::uint32_t x = 0; x < side; ++x) {
      const auto cost = [&](std::uint64_t i) {
        return float(std::floor(12.0 * randomUnit(seed + 99, (std::uint64_t(y) * side + x) * 4 + i)));
      };
      const std::uint32_t v = y * side + x;
      if (x + 1 < side) problem.pairs.push_back({v, v + 1, cost(0), cost(1)});
      if (y + 1 < side) problem.pairs.push_back({v, v + side, cost(2), cost(3)});
    }
  return problem;
}

double solved(MinCut& cut, const Problem& problem, std::vector<bool>& takes) {
  cut.reset(problem.keep.size());
  for (std::uint32_t i = 0; i < problem.keep.size(); ++i) cut.addOwn(i, problem.keep[i], problem.take[i]);
  for (const Pair& p : problem.pairs) cut.addPair(p.i, p.j, p.keepTake, p.takeKeep);
  const double least = cut.solve();
  takes.clear();
  for (std::uint32_t i = 0; i < problem.keep.size(); ++i) takes.push_back(cut.takes(i));
  return least;
}

double leastByTrial(const Problem& problem) {
  double least = std::numeric_limits<double>::infinity();
  std::vector<bool> takes(problem.keep.size());
  for (std::uint32_t bits = 0; bits < 1u << problem.keep.size(); ++bits) {
    for (std::size_t i = 0; i < takes.size(); ++i) takes[i] = bits >> i & 1;
    least = std::min(least, problem.cost(takes));
  }
  return least;
}

double leastByPushRelabel(const Problem& problem) {
  using Traits = boost::adjacency_list_traits<boost::vecS, boost::vecS, boost::directedS>;
  using Graph = boost::adjacency_list<
      boost::vecS, boost::vecS, boost::directedS, boost::no_property,
      boost::property<boost::edge_capacity_t, double,
                      boost::property<boost::edge_residual_capacity_t, double,
                                      boost::property<boost::edge_reverse_t, Traits::edge_descriptor>>>>;
  const std::size_t count = problem.keep.size(), source = count, sink = count + 1;
  Graph graph(count + 2);
  const auto add = [&](std::size_t i, std::size_t j, double capacity) {
    const auto a = boost::add_edge(i, j, graph).first, b = boost::add_edge(j, i, graph).first;
    boost::put(boost::edge_capacity, graph, a, capacity);
    boost::put(boost::edge_capacity, graph, b, 0.0);
    boost::put(boost::edge_reverse, graph, a, b);
    boost::put(boost::edge_reverse, graph, b, a);
  };
  for (std::size_t i = 0; i < count; ++i) {
    add(source, i, problem.take[i]);
    add(i, sink, problem.keep[i]);
  }
  // Boost's own check of the flow knows no reverse edges that have a capacity.
  for (const Pair& p : problem.pairs) add(p.i, p.j, p.keepTake), add(p.j, p.i, p.takeKeep);
  return boost::push_relabel_max_flow(graph, source, sink);
}

}  // namespace

TEST_CASE("min_cut: small problems, against every labelling") {
  MinCut cut;
  std::vector<bool> takes;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const Problem problem = randomProblem(2 + seed % 9, seed % 40, seed);
    const double least = solved(cut, problem, takes);
    CHECK(least == problem.cost(takes));
    CHECK(least == leastByTrial(problem));
  }
}

TEST_CASE("min_cut: pieces as large as those of a surface, against push-relabel") {
  MinCut cut;
  std::vector<bool> takes;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Problem problem = gridProblem(8 + 3 * std::uint32_t(seed), seed);
    const double least = solved(cut, problem, takes);
    CHECK(least == problem.cost(takes));
    CHECK(least == Approx(leastByPushRelabel(problem)));
  }
}

TEST_CASE("min_cut: where both are as good a node keeps, and an empty problem costs nothing") {
  MinCut cut;
  cut.reset(0);
  CHECK(cut.solve() == 0.0);
  cut.reset(2);
  cut.addOwn(0, 3.0f, 3.0f);
  cut.addPair(0, 1, 1.0f, 1.0f);
  CHECK(cut.solve() == 3.0);
  CHECK_FALSE(cut.takes(0));
  CHECK_FALSE(cut.takes(1));
}
