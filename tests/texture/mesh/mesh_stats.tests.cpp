#include "texture/mesh/mesh_stats.h"

#include "closed_meshes.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex::texture;

TEST_CASE("meshStats: two regular tetrahedra are two components with edges of one length", "[texture]") {
  std::vector<Vec3f> positions;
  std::vector<Vec3I> triangles;
  for (int copy = 0; copy < 2; ++copy) {
    const auto base = static_cast<unsigned>(positions.size());
    for (const Vec3f& corner : {Vec3f(1, 1, 1), Vec3f(1, -1, -1), Vec3f(-1, 1, -1), Vec3f(-1, -1, 1)})
      positions.push_back(corner + Vec3f(10.0f * static_cast<float>(copy), 0.0f, 0.0f));
    for (const Vec3I& face : {Vec3I(0, 1, 2), Vec3I(0, 3, 1), Vec3I(0, 2, 3), Vec3I(1, 3, 2)})
      triangles.push_back(face + Vec3I(base));
  }
  const MeshStats stats = meshStats(positions, triangles);
  CHECK(stats.components == 2);
  CHECK(stats.edgeMean == Approx(std::sqrt(8.0)));
  CHECK(stats.edgeCv == Approx(0.0).margin(1e-6));
  CHECK(stats.folded == 12);  // normals of a tetrahedron's sides are 109 degrees apart
}

TEST_CASE("meshStats: coefficient of variation of a right triangle with sides 3, 4, 5", "[texture]") {
  const MeshStats stats = meshStats({{0, 0, 0}, {3, 0, 0}, {0, 4, 0}}, {{0, 1, 2}});
  CHECK(stats.components == 1);
  CHECK(stats.edgeMean == Approx(4.0));
  CHECK(stats.edgeCv == Approx(std::sqrt(2.0 / 3.0) / 4.0));
}

TEST_CASE("meshStats: nothing gives zeros", "[texture]") {
  CHECK(meshStats({}, {}).components == 0);
}

TEST_CASE("meshStats: a vertex that is pulled out is a spike, and right angles are no folds", "[texture]") {
  const SurfaceMesh ball = fluidtex::testing::sphereMesh(8);
  const MeshStats smooth = meshStats(ball.positions, ball.triangles, ball.normals);
  CHECK(smooth.folded == 0);
  CHECK(smooth.spikes == 0);
  // By 0.4 and 0.7 of an edge: only then it is farther from its neighbours than half of one.
  for (const float out : {0.4f, 0.7f}) {
    std::vector<Vec3f> positions = ball.positions;
    positions[50] += ball.normals[50] * (out * float(ball.spacing));
    CHECK(meshStats(positions, ball.triangles, ball.normals).spikes == (out > 0.5f ? 1 : 0));
    CHECK(meshStats(positions, ball.triangles).spikes == 0);
  }
  // Through the ball and out at its other side.
  std::vector<Vec3f> positions = ball.positions;
  positions[50] *= 0.2f;
  CHECK(meshStats(positions, ball.triangles, ball.normals).folded >= 3);
  const SurfaceMesh box = fluidtex::testing::boxMesh({0, 0, 0}, {1, 1, 1}, {3, 3, 3});
  CHECK(meshStats(box.positions, box.triangles, box.normals).folded == 0);
}
