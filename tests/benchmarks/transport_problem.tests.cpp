#include "tools/benchmarks/transport_problem.h"

#include "transport/carry.h"

#include <catch2/catch.hpp>

using namespace fluidtex;

TEST_CASE("transport problem: transport takes it, and nearly all of its texture arrives") {
  const benchmarks::TransportProblem problem = benchmarks::transportProblem(2000);
  REQUIRE(problem.frame.substeps.size() == std::size_t(benchmarks::kTransportSubsteps));
  const texture::Carried carried = transport::carry(problem.previous, problem.frame, problem.next);
  REQUIRE(carried.coordinate.size() == problem.next.positions.size());
  std::size_t arrived = 0;
  for (std::size_t v = 0; v < carried.trust.size(); ++v)
    arrived += carried.trust[v] > 0.5f && carried.coordinate[v] == texture::Vec2f(1.0f, 2.0f);
  CHECK(double(arrived) > 0.99 * double(carried.trust.size()));
}
