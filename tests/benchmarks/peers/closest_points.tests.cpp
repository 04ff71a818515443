#include "tools/benchmarks/peers/closest_points.h"

#include "numerics/random.h"
#include "tests/texture/mesh/closed_meshes.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace fluidtex;
using benchmarks::cgalClosest;
using benchmarks::ClosestRun;
using benchmarks::embreeClosest;
using texture::Vec3f;

namespace {

// Of a point to the surface of the unit cube.
double fromCube(const Vec3f& p) {
  double outside = 0.0, inside = 1.0;
  for (int a = 0; a < 3; ++a) {
    const double x = double(p[a]), beyond = std::max({-x, x - 1.0, 0.0});
    outside += beyond * beyond;
    inside = std::min({inside, x, 1.0 - x});
  }
  return outside > 0.0 ? std::sqrt(outside) : inside;
}

}  // namespace

TEST_CASE("closest peers: distances from a cube's faces, edges and corners", "[benchmarks]") {
  const texture::SurfaceMesh cube = testing::boxMesh({0, 0, 0}, {1, 1, 1}, {4, 3, 5});
  const std::pair<Vec3f, double> known[] = {{{0.3f, 0.6f, 3.0f}, 2.0},               // above a face
                                            {{0.3f, 0.6f, 0.75f}, 0.25},             // below it
                                            {{0.5f, 0.5f, 0.5f}, 0.5},               // in the middle
                                            {{2.0f, 0.4f, -1.0f}, std::sqrt(2.0)},   // beside an edge
                                            {{-1.0f, -1.0f, 2.0f}, std::sqrt(3.0)},  // beyond a corner
                                            {{1.0f, 0.2f, 0.7f}, 0.0}};              // on it
  for (const auto& [point, distance] : known) {
    CAPTURE(point);
    CHECK(embreeClosest(cube.positions, cube.triangles, {point}).sum == Approx(distance).margin(1e-6));
    CHECK(cgalClosest(cube.positions, cube.triangles, {point}).sum == Approx(distance).margin(1e-6));
  }
}

TEST_CASE("closest peers: the sum is that of all distances", "[benchmarks]") {
  const texture::SurfaceMesh cube = testing::boxMesh({0, 0, 0}, {1, 1, 1}, {7, 8, 9});
  std::vector<Vec3f> queries;
  double sum = 0.0;
  for (std::uint64_t n = 0; n < 1000; ++n) {
    Vec3f p;
    for (int a = 0; a < 3; ++a) p[a] = float(3.0 * randomUnit(2, 3 * n + std::uint64_t(a)) - 1.0);
    queries.push_back(p);
    sum += fromCube(p);
  }
  for (const auto& closest : {embreeClosest, cgalClosest}) {
    const ClosestRun run = closest(cube.positions, cube.triangles, queries);
    CHECK(run.sum == Approx(sum).epsilon(1e-5));
    CHECK(run.build > 0.0);
    CHECK(run.query > 0.0);
    CHECK(closest(cube.positions, cube.triangles, {}).sum == 0.0);
  }
}
