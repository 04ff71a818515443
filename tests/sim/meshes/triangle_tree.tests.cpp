#include "sim/meshes/triangle_tree.h"

#include "sim/options.h"
#include "tests/sim/meshes/somewhere.h"

#include <openvdb/math/Proximity.h>

#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex::sim;

namespace {

TriangleMesh triangles(int count, double size) {
  TriangleMesh mesh;
  for (int n = 0; n < count; ++n) {
    for (int k = 0; k < 3; ++k) mesh.positions.emplace_back(somewhere(n) + size * somewhere(7919 * k + n));
    mesh.triangles.emplace_back(3 * n, 3 * n + 1, 3 * n + 2);
  }
  return mesh;
}

}  // namespace

TEST_CASE("triangle tree: the closest point is that of all triangles, whatever one guesses") {
  for (const int count : {1, 2, 4, 5, 9, 23, 300, 10000}) {
    const TriangleMesh mesh = triangles(count, count < 100 ? 0.3 : 0.05);
    const TriangleTree tree(mesh);
    const int places = count > 1000 ? 20 : 100;
    for (int n = 0; n < places; ++n) {
      const Vec3d x = 2.0 * somewhere(31 * n) - Vec3d(0.5);
      double nearest = kForever;
      for (const openvdb::Vec3I& t : mesh.triangles) {
        Vec3d weight;
        const Vec3d at = openvdb::math::closestPointOnTriangleToPoint(
            Vec3d(mesh.positions[t[0]]), Vec3d(mesh.positions[t[1]]), Vec3d(mesh.positions[t[2]]), x, weight);
        nearest = std::min(nearest, (at - x).lengthSqr());
      }
      for (const double guess : {0.0, 0.9 * std::sqrt(nearest), 1.1 * std::sqrt(nearest), 10.0}) {
        const TriangleTree::Closest closest = tree.closest(x, guess);
        REQUIRE(closest.square == nearest);
        Vec3d at(0.0);
        for (int k = 0; k < 3; ++k)
          at += closest.weight[k] * Vec3d(mesh.positions[mesh.triangles[closest.triangle][k]]);
        REQUIRE((at - x).lengthSqr() == Approx(nearest).margin(1e-12));
      }
    }
  }
}

TEST_CASE("triangle tree: of triangles as near it is the first, and there may be none") {
  TriangleMesh mesh = triangles(1, 0.3);
  for (int n = 0; n < 40; ++n) mesh.triangles.push_back(mesh.triangles[0]);
  const TriangleTree tree(mesh);
  for (int n = 0; n < 50; ++n) CHECK(tree.closest(somewhere(n), 0.1).triangle == 0);
  CHECK(TriangleTree(TriangleMesh{}).closest(Vec3d(0.0), 1.0).triangle == -1);
}
