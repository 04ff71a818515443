#include "texture/mesh_stats.h"

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
}

TEST_CASE("meshStats: coefficient of variation of a right triangle with sides 3, 4, 5", "[texture]") {
  const MeshStats stats = meshStats({{0, 0, 0}, {3, 0, 0}, {0, 4, 0}}, {{0, 1, 2}});
  CHECK(stats.components == 1);
  CHECK(stats.edgeMean == Approx(4.0));
  CHECK(stats.edgeCv == Approx(std::sqrt(2.0 / 3.0) / 4.0));
}

TEST_CASE("meshStats: nothing gives zeros", "[texture]") { CHECK(meshStats({}, {}).components == 0); }
