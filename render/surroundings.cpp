#include "render/surroundings.h"

#include <array>

namespace fluidtex::render {
namespace {

// Thickness of the rods, and how far the ground lies below the domain, in diagonals of the domain.
constexpr double kRod = 0.0045, kGroundGap = 0.0005;

Mesh makeGround(const Vec3d& color, const Vec3d& size) {
  const double reach = kGroundFadeTo * size.length(), z = -kGroundGap * size.length();
  const double x = 0.5 * size[0], y = 0.5 * size[1];
  Mesh ground;
  ground.kind = MeshKind::ground;
  ground.color = Vec3f(color);
  for (const auto& [i, j] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
    ground.positions.emplace_back(static_cast<float>(x + i * reach), static_cast<float>(y + j * reach),
                                  static_cast<float>(z));
  ground.triangles = {{0, 1, 2}, {0, 2, 3}};
  return ground;
}

void addBox(Mesh& mesh, const Vec3d& low, const Vec3d& high) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3d p(corner & 1 ? high[0] : low[0], corner & 2 ? high[1] : low[1],
                  corner & 4 ? high[2] : low[2]);
    mesh.positions.emplace_back(p);
  }
  constexpr std::array<std::array<std::uint32_t, 4>, 6> kFaces{
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  for (const auto& f : kFaces) {
    mesh.triangles.emplace_back(first + f[0], first + f[1], first + f[2]);
    mesh.triangles.emplace_back(first + f[0], first + f[2], first + f[3]);
  }
}

// Four posts outside the vertical edges; between them, four rods on the ground and four at the top.
Mesh makeTank(const Vec3d& color, const Vec3d& size) {
  const double rod = kRod * size.length(), bottom = -kGroundGap * size.length();
  Mesh tank;
  tank.color = Vec3f(color);
  const Vec3d low(-rod, -rod, bottom), high(size[0] + rod, size[1] + rod, size[2]);
  for (int corner = 0; corner < 4; ++corner) {
    const double x = corner & 1 ? size[0] : -rod, y = corner & 2 ? size[1] : -rod;
    addBox(tank, Vec3d(x, y, low[2]), Vec3d(x + rod, y + rod, high[2]));
  }
  for (const double z : {0.0, size[2] - rod}) {
    const double from = z == 0.0 ? bottom : z;
    for (const double y : {-rod, size[1]})
      addBox(tank, Vec3d(0.0, y, from), Vec3d(size[0], y + rod, z + rod));
    for (const double x : {-rod, size[0]})
      addBox(tank, Vec3d(x, 0.0, from), Vec3d(x + rod, size[1], z + rod));
  }
  return tank;
}

}  // namespace

std::vector<Mesh> surroundingMeshes(const Surroundings& surroundings, const Vec3d& domainSize) {
  std::vector<Mesh> meshes;
  if (surroundings.ground) meshes.push_back(makeGround(surroundings.groundColor, domainSize));
  if (surroundings.tank) meshes.push_back(makeTank(surroundings.tankColor, domainSize));
  return meshes;
}

}  // namespace fluidtex::render
