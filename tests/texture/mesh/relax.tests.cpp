#include "texture/mesh/relax.h"

#include "tests/texture/mesh/ball_mesh.h"
#include "texture/mesh/remesh.h"

#include <catch2/catch.hpp>

using namespace fluidtex::texture;

TEST_CASE("relax: vertices whose ring a patch owns move, those at its rim and those at rest stay") {
  BallMesh ball(8.0);
  ball.mesh.compact(ball.mesh.vertexCount());
  flipToDelaunay(ball.mesh);
  const Patches patches = patchesOf(ball.mesh, 8.0f);
  REQUIRE(patches.count() > 4);
  std::vector<char> free(ball.mesh.vertexCount(), 0);
  for (std::uint32_t v = 0; v < ball.mesh.vertexCount(); ++v)
    free[v] = patches.ownsRing(ball.mesh, patches.of[v], v);
  const std::vector<Vec3f> start = ball.mesh.position;
  std::vector<std::uint8_t> asleep(ball.mesh.vertexCount(), 0);
  relax(ball.mesh, ball.phi, patches, kEdgePerSpacing, 3, 1e6f, asleep);
  CHECK(ball.mesh.position == start);
  std::vector<std::uint8_t> awake(ball.mesh.vertexCount(), 1);
  relax(ball.mesh, ball.phi, patches, kEdgePerSpacing, 1, 0.0f, awake);
  std::size_t moved = 0, wanted = 0;
  for (std::uint32_t v = 0; v < ball.mesh.vertexCount(); ++v) {
    if (free[v] == 0) continue;
    ++wanted;
    moved += ball.mesh.position[v] != start[v];
  }
  CHECK(moved > wanted / 2);
  std::size_t rim = 0;
  for (std::uint32_t v = 0; v < ball.mesh.vertexCount(); ++v)
    if (!patches.ownsRing(ball.mesh, patches.of[v], v) && free[v] == 0)
      rim += ball.mesh.position[v] != start[v];
  CHECK(rim == 0);
  ball.mesh.compact(ball.mesh.vertexCount());
  CHECK(isClosedManifold(ball.mesh.vertexCount(), trianglesOf(ball.mesh)));
}
