#include "sim/meshes/turned_outward.h"

#include "tests/sim/meshes/mesh_files.h"

#include <catch2/catch.hpp>

#include <string>

using namespace fluidtex::sim;

TEST_CASE("turned outward: cubes that share a face, an edge or a corner are one solid", "[sim]") {
  // 2 x 2 x 2 cubes side by side, of vertices of their own; without those of one diagonal plane, so that some
  // meet at edges only; each once turned anyhow.
  const auto cubes = [](auto has, auto isInward) {
    std::string text, faces;
    int first = 1;
    for (int n = 0; n < 8; ++n) {
      if (!has(n)) continue;
      const Vec3d low(n & 1, n >> 1 & 1, n >> 2 & 1);
      text += boxCorners(low, low + Vec3d(1.0));
      faces += facesFrom(first, isInward(n));
      first += 8;
    }
    return text + faces;
  };
  const auto all = [](int) { return true; };
  const auto none = [](int) { return false; };
  const auto some = [](int n) { return n == 0 || n == 3 || n == 5 || n == 6; };
  CHECK(volumeOf(meshOf("all.obj", cubes(all, none))) == Approx(8.0));
  CHECK(volumeOf(meshOf("all.obj", cubes(all, all))) == Approx(8.0));
  CHECK(volumeOf(meshOf("all.obj", cubes(all, some))) == Approx(8.0));
  CHECK(volumeOf(meshOf("diagonal.obj", cubes(some, none))) == Approx(4.0));
  CHECK(volumeOf(meshOf("diagonal.obj", cubes(some, [](int n) { return n == 3; }))) == Approx(4.0));
  CHECK(volumeOf(meshOf("seven.obj", cubes([](int n) { return n != 7; }, none))) == Approx(7.0));
  // No wall is left within.
  CHECK(meshOf("all.obj", cubes(all, none)).triangles.size() == 48);
  // Every face twice, as programs write surfaces that are seen from both sides.
  CHECK(volumeOf(meshOf("twice.obj", boxObj(Vec3d(0.3, 0.3, -0.1), Vec3d(0.7, 0.7, 0.6)) +
                                         facesFrom(1, true))) == Approx(0.4 * 0.4 * 0.7));
  CHECK(volumeOf(meshOf("twice.obj", boxObj(Vec3d(0.3, 0.3, -0.1), Vec3d(0.7, 0.7, 0.6)) + facesFrom(1))) ==
        Approx(0.4 * 0.4 * 0.7));
}

TEST_CASE("turned outward: a surface within another one is a cavity's, whichever way it is turned", "[sim]") {
  const auto nested = [](bool outerInward, bool innerInward, bool coreInward) {
    return boxCorners(Vec3d(0.0), Vec3d(5.0)) + boxCorners(Vec3d(1.0), Vec3d(4.0)) +
           boxCorners(Vec3d(2.0), Vec3d(3.0)) + facesFrom(1, outerInward) + facesFrom(9, innerInward) +
           facesFrom(17, coreInward);
  };
  for (int n = 0; n < 8; ++n)
    CHECK(volumeOf(meshOf("nested.obj", nested(n & 1, n & 2, n & 4))) == Approx(125.0 - 27.0 + 1.0));
  // Side by side, and across each other: both solid.
  CHECK(volumeOf(meshOf("two.obj", boxCorners(Vec3d(0.0), Vec3d(1.0)) + boxCorners(Vec3d(2.0), Vec3d(3.0)) +
                                       facesFrom(1) + facesFrom(9, true))) == Approx(2.0));
  CHECK(volumeOf(meshOf("cross.obj", boxCorners(Vec3d(0, 0, 0), Vec3d(3, 1, 1)) +
                                         boxCorners(Vec3d(1, -1, 0.2), Vec3d(2, 2, 0.8)) + facesFrom(1) +
                                         facesFrom(9, true))) == Approx(3.0 + 1.8));
}

TEST_CASE("turned outward: triangles are kept but for their direction, a one-sided part is refused",
          "[sim]") {
  TriangleMesh mesh = meshOf("box.obj", boxObj(Vec3d(0.0), Vec3d(1.0)));
  const std::vector<openvdb::Vec3I> outward = mesh.triangles;
  for (std::size_t n = 0; n < mesh.triangles.size(); n += 3)
    std::swap(mesh.triangles[n][1], mesh.triangles[n][2]);
  const auto turned = turnedOutward(mesh);
  REQUIRE(turned);
  REQUIRE(turned->size() == outward.size());
  mesh.triangles = *turned;
  CHECK(volumeOf(mesh) == Approx(1.0));
  CHECK(isClosed(mesh));

  // The projective plane, of six vertices: closed, and with one side.
  TriangleMesh plane;
  for (int n = 0; n < 6; ++n) plane.positions.emplace_back(float(n), float(n * n), float(n * n * n));
  for (const auto& [a, b, c] : {std::array{0, 1, 2},
                                {0, 2, 3},
                                {0, 3, 4},
                                {0, 4, 5},
                                {0, 5, 1},
                                {1, 2, 4},
                                {2, 3, 5},
                                {3, 4, 1},
                                {4, 5, 2},
                                {5, 1, 3}})
    plane.triangles.emplace_back(a, b, c);
  CHECK_FALSE(turnedOutward(plane));
}
