#include "texture/mesh/remesh.h"

#include "tests/texture/mesh/ball_mesh.h"
#include "tests/texture/mesh/icosahedron.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace fluidtex::texture;

namespace {

// The sum of the angles opposite an edge.
double oppositeAngles(const EditableMesh& mesh, std::uint32_t h) {
  double sum = 0.0;
  for (const std::uint32_t side : {h, mesh.twin[h]}) {
    const Vec3d c(mesh.position[mesh.opposite(side)]), a = Vec3d(mesh.position[mesh.origin[side]]) - c,
                                                       b = Vec3d(mesh.position[mesh.target(side)]) - c;
    sum += std::atan2(a.cross(b).length(), a.dot(b));
  }
  return sum;
}

}  // namespace

TEST_CASE("remesh: facing is the worst cosine between a triangle and its corners' normals") {
  const Vec3f p[3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const Vec3f up[3] = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
  const Vec3f one[3] = {{0, 0, 1}, {0.6f, 0, 0.8f}, {0, 0, 1}};
  const Vec3f line[3] = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  CHECK(facing(p, up) == Approx(1.0f));
  CHECK(facing(p, one) == Approx(0.8f));
  CHECK(facing(line, up) == -1.0f);
  CHECK(mayFace(0.2f, 0.9f));
  CHECK_FALSE(mayFace(0.05f, 0.06f));
  CHECK(mayFace(-0.5f, -0.6f));
}

TEST_CASE("remesh: after flips no edge's opposite angles are more than pi") {
  BallMesh ball(10.0);
  flipToDelaunay(ball.mesh);
  double worst = 0.0;
  for (std::uint32_t h = 0; h < ball.mesh.halfEdgeCount(); ++h)
    if (ball.mesh.alive(h) && ball.mesh.canFlip(h)) worst = std::max(worst, oppositeAngles(ball.mesh, h));
  CHECK(worst < M_PI + 0.05);
  const std::vector<std::uint32_t> origin = ball.mesh.origin;
  flipToDelaunay(ball.mesh);
  CHECK(ball.mesh.origin == origin);
}

TEST_CASE("remesh: long edges are split on the surface until there are none") {
  BallMesh ball(10.0, 3.0f);
  splitLongEdges(ball.mesh, ball.phi, 1.5f);
  float longest = 0.0f, farthest = 0.0f;
  for (std::uint32_t h = 0; h < ball.mesh.halfEdgeCount(); ++h)
    if (ball.mesh.alive(h))
      longest = std::max(
          longest,
          (ball.mesh.position[ball.mesh.origin[h]] - ball.mesh.position[ball.mesh.target(h)]).length());
  for (const Vec3f& x : ball.mesh.position)
    farthest = std::max(farthest, std::abs((x - Vec3f(0.3f, 0.1f, 0.2f)).length() - 10.0f));
  CHECK(longest <= 1.5f);
  CHECK(farthest < 0.05f);
}

TEST_CASE("remesh: evened out there are as many points as wanted, and a second call changes nothing") {
  BallMesh ball(8.0);
  const double wanted = area(ball.surface.positions, ball.surface.triangles);
  evenOut(ball.mesh, ball.phi, {1.0f, wanted, 30, false});
  CHECK(double(aliveIn(ball.mesh)) == Approx(wanted).epsilon(0.02));
  ball.mesh.compact(ball.mesh.vertexCount());
  double sum = 0.0, squares = 0.0;
  for (std::uint32_t h = 0; h < ball.mesh.halfEdgeCount(); ++h) {
    const double edge =
        (ball.mesh.position[ball.mesh.origin[h]] - ball.mesh.position[ball.mesh.target(h)]).length();
    sum += edge;
    squares += edge * edge;
  }
  const double mean = sum / double(ball.mesh.halfEdgeCount());
  CHECK(mean == Approx(kEdgePerSpacing).epsilon(0.03));
  CHECK(std::sqrt(squares / double(ball.mesh.halfEdgeCount()) - mean * mean) < 0.15 * mean);
  const std::vector<Vec3f> positions = ball.mesh.position;
  evenOut(ball.mesh, ball.phi, {1.0f, wanted, 30, true, true});
  CHECK(ball.mesh.position == positions);
}

TEST_CASE("remesh: no collapse turns a triangle over") {
  EditableMesh mesh = icosahedron();
  for (std::uint32_t h = 0; h < mesh.halfEdgeCount(); ++h)
    if (mesh.alive(h)) tryCollapse(mesh, h);
  for (std::uint32_t v = 0; v < 12; ++v)
    if (mesh.outgoing[v] != kNone) CHECK(worstFacing(mesh, v) >= kFacing);
}
