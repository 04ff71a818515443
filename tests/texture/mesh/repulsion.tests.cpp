#include "texture/mesh/repulsion.h"

#include "tests/texture/mesh/ball_mesh.h"
#include "texture/mesh/remesh.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numeric>

using namespace fluidtex::texture;

TEST_CASE("repulsion: sweeps even out edges, move no vertex far at once, and keep to the surface") {
  BallMesh ball(8.0);
  ball.mesh.compact(ball.mesh.vertexCount());
  flipToDelaunay(ball.mesh);
  const auto unevenness = [&] {
    double sum = 0.0, squares = 0.0;
    const double n = double(ball.mesh.halfEdgeCount());
    for (std::uint32_t h = 0; h < ball.mesh.halfEdgeCount(); ++h) {
      const double edge =
          (ball.mesh.position[ball.mesh.origin[h]] - ball.mesh.position[ball.mesh.target(h)]).length();
      sum += edge;
      squares += edge * edge;
    }
    return std::sqrt(squares / n - sum * sum / (n * n)) / (sum / n);
  };
  const double before = unevenness();
  Repulsion repulsion(ball.mesh, ball.phi, kEdgePerSpacing);
  repulsion.awake.assign(ball.mesh.vertexCount(), 1);
  std::vector<std::uint32_t> active(ball.mesh.vertexCount());
  std::iota(active.begin(), active.end(), 0u);
  const std::vector<Vec3f> start = ball.mesh.position;
  repulsion.sweep(active, 0.0f, 0.0f);
  for (std::size_t v = 0; v < start.size(); ++v)
    REQUIRE((ball.mesh.position[v] - start[v]).length() <= 1.1f * kLongestMove * kEdgePerSpacing);
  for (int n = 0; n < 20 && !active.empty(); ++n) {
    flipToDelaunay(ball.mesh);
    repulsion.sweep(active, 0.0f, 0.0f);
  }
  CHECK(unevenness() < 0.8 * before);
  for (const Vec3f& x : ball.mesh.position)
    REQUIRE(std::abs((x - Vec3f(0.3f, 0.1f, 0.2f)).length() - 8.0f) < 0.1f);
}

TEST_CASE("repulsion: who sleeps and is hardly pushed stays") {
  BallMesh ball(6.0);
  ball.mesh.compact(ball.mesh.vertexCount());
  Repulsion repulsion(ball.mesh, ball.phi, kEdgePerSpacing);
  repulsion.awake.assign(ball.mesh.vertexCount(), 0);
  std::vector<std::uint32_t> active(ball.mesh.vertexCount());
  std::iota(active.begin(), active.end(), 0u);
  const std::vector<Vec3f> start = ball.mesh.position;
  repulsion.sweep(active, 1e6f, 0.0f);
  CHECK(ball.mesh.position == start);
  CHECK(active.empty());
}
