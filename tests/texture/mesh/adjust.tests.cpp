#include "texture/mesh/adjust.h"

#include "tests/texture/mesh/ball_mesh.h"
#include "texture/mesh/remesh.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex::texture;

TEST_CASE("adjust: the number of vertices gets within the slack, from below and from above") {
  for (const double share : {0.95, 1.0, 1.05}) {
    BallMesh ball(8.0);
    evenOut(ball.mesh, ball.phi, {1.0f, area(ball.surface.positions, ball.surface.triangles), 30, false});
    ball.mesh.compact(ball.mesh.vertexCount());
    const double wanted = share * double(ball.mesh.vertexCount());
    const float edge = kEdgePerSpacing / float(std::sqrt(share));
    const auto changed = adjustNumber(ball.mesh, ball.phi, {edge, wanted, 0.01, false});
    CAPTURE(share);
    CHECK(std::abs(double(aliveIn(ball.mesh)) / wanted - 1.0) <= 0.011);
    CHECK(changed.empty() == (share == 1.0));
    ball.mesh.compact(ball.mesh.vertexCount());
    CHECK(isClosedManifold(ball.mesh.vertexCount(), trianglesOf(ball.mesh)));
  }
}
