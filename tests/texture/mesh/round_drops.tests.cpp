#include "texture/mesh/round_drops.h"

#include "tests/texture/levelset/level_sets.h"
#include "tests/texture/mesh/characteristics.h"
#include "tests/texture/mesh/icosahedron.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex::texture;

TEST_CASE("round drops: a component of few vertices becomes a ball about its middle, others stay") {
  const LevelSet phi(*sphereGrid(2.0, 1.0, Vec3d(0.0)));
  EditableMesh mesh = icosahedron();
  REQUIRE(mesh.vertexCount() < kBallVertices);
  EditableMesh far = icosahedron();
  for (Vec3f& x : far.position) x += Vec3f(20.0f, 0.0f, 0.0f);
  mesh.append(far);
  CHECK_FALSE(roundOffDrops(mesh, phi, {}));
  CHECK(roundOffDrops(mesh, phi, {2}));
  mesh.compact(mesh.vertexCount());
  CHECK(mesh.vertexCount() == 12 + kBallVertices);
  CHECK(fluidtex::testing::characteristics(mesh.vertexCount(), trianglesOf(mesh)) ==
        std::map<long, int>{{2, 2}});
  const float radius = icosahedron().position[0].length();
  Vec3f middle(0.0f);
  std::vector<std::uint32_t> ball;
  for (std::uint32_t v = 0; v < mesh.vertexCount(); ++v) {
    const Vec3f& x = mesh.position[v];
    if (x.x() > 10.0f) continue;
    ball.push_back(v);
    middle += x;
    CHECK(x.length() == Approx(radius).epsilon(0.02));
  }
  CHECK(ball.size() == kBallVertices);
  CHECK((middle / float(ball.size())).length() < 1e-3f);
  CHECK_FALSE(roundOffDrops(mesh, phi, ball));
}
