#include "render/surroundings.h"

#include <catch2/catch.hpp>

#include <map>

using namespace fluidtex::render;

TEST_CASE("surroundings: only what is asked for is built", "[render]") {
  Surroundings surroundings;
  REQUIRE(surroundingMeshes(surroundings, Vec3d(1.0)).size() == 2);
  surroundings.tank = false;
  REQUIRE(surroundingMeshes(surroundings, Vec3d(1.0)).size() == 1);
  REQUIRE(surroundingMeshes(surroundings, Vec3d(1.0))[0].kind == MeshKind::ground);
  surroundings.ground = false;
  REQUIRE(surroundingMeshes(surroundings, Vec3d(1.0)).empty());
}

TEST_CASE("surroundings: the ground lies below the domain, faces up and reaches to where it has faded",
          "[render]") {
  const Vec3d size(3.0, 1.0, 0.5);
  const Mesh ground = surroundingMeshes(Surroundings(), size)[0];
  float reach = 1e9f;
  for (const auto& p : ground.positions) {
    REQUIRE(p[2] < 0.0f);
    REQUIRE(p[2] > -0.01f);
    reach = std::min(reach, std::abs(p[0] - 1.5f));
  }
  REQUIRE(reach >= kGroundFadeTo * size.length() * 0.999);
  for (const auto& t : ground.triangles) {
    const Vec3f& a = ground.positions[t[0]];
    REQUIRE((ground.positions[t[1]] - a).cross(ground.positions[t[2]] - a)[2] > 0.0f);
  }
  REQUIRE(groundOpacity(0.0f) == 1.0f);
  REQUIRE(groundOpacity(kGroundFadeTo) == 0.0f);
}

TEST_CASE("surroundings: the tank's rods are closed, face outward and stay out of the domain", "[render]") {
  for (const Vec3d& size : {Vec3d(1.0), Vec3d(2.0, 0.7, 0.4)}) {
    const Mesh tank = surroundingMeshes(Surroundings(), size)[1];
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    double volume = 0.0;
    for (const auto& t : tank.triangles) {
      for (int k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
      volume +=
          Vec3d(tank.positions[t[0]]).dot(Vec3d(tank.positions[t[1]]).cross(Vec3d(tank.positions[t[2]]))) /
          6.0;
      Vec3d middle(0.0);
      for (int k = 0; k < 3; ++k) middle += Vec3d(tank.positions[t[k]]) / 3.0;
      const bool inside =
          middle[0] > 1e-6 && middle[0] < size[0] - 1e-6 && middle[1] > 1e-6 && middle[1] < size[1] - 1e-6;
      REQUIRE_FALSE(inside);
    }
    for (const auto& [edge, count] : edges) {
      REQUIRE(count == 1);
      REQUIRE(edges.count({edge.second, edge.first}) == 1);
    }
    // Outward faces have positive volume: four posts, eight rods, of a square section, less than the domain
    // by far.
    const double section = std::pow(0.0045 * size.length(), 2.0);
    const double length = 4.0 * (size[0] + size[1] + size[2]);
    REQUIRE(volume == Approx(section * length).epsilon(0.1));
  }
}
