#include "texture/mesh/round_drops.h"

#include <algorithm>

namespace fluidtex::texture {
namespace {

using openvdb::Vec3d;

// On the unit sphere, counter-clockwise seen from outside.
EditableMesh unitBall() {
  std::vector<Vec3f> unit{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  std::vector<Vec3I> triangles;
  const auto between = [&](std::uint32_t a, std::uint32_t b) {
    const Vec3f way = (unit[a] + unit[b]).unit();
    const auto known = std::find(unit.begin(), unit.end(), way);
    if (known != unit.end()) return std::uint32_t(known - unit.begin());
    unit.push_back(way);
    return std::uint32_t(unit.size() - 1);
  };
  for (std::uint32_t octant = 0; octant < 8; ++octant) {
    const std::uint32_t x = octant & 1 ? 3 : 0;
    std::uint32_t y = octant & 2 ? 4 : 1, z = octant & 4 ? 5 : 2;
    if (((octant ^ octant >> 1 ^ octant >> 2) & 1) != 0) std::swap(y, z);
    const std::uint32_t xy = between(x, y), yz = between(y, z), zx = between(z, x);
    for (const Vec3I& t : {Vec3I(x, xy, zx), Vec3I(xy, y, yz), Vec3I(zx, yz, z), Vec3I(xy, yz, zx)})
      triangles.push_back(t);
  }
  EditableMesh ball = makeEditableMesh(unit, triangles);
  ball.normal = unit;
  return ball;
}

// Component of `start`; nothing if it has at least as many vertices as a ball.
std::vector<std::uint32_t> smallComponent(const EditableMesh& mesh, std::uint32_t start) {
  std::vector<std::uint32_t> found{start};
  for (std::size_t next = 0; next < found.size(); ++next) {
    if (found.size() >= kBallVertices) return {};
    mesh.around(found[next], [&](std::uint32_t h) {
      const std::uint32_t v = mesh.target(h);
      if (std::find(found.begin(), found.end(), v) == found.end()) found.push_back(v);
    });
  }
  return found.size() < kBallVertices ? found : std::vector<std::uint32_t>{};
}

bool hasHandle(const EditableMesh& mesh, const std::vector<std::uint32_t>& component) {
  std::size_t halfEdges = 0;
  for (std::uint32_t v : component) halfEdges += std::size_t(mesh.valence(v));
  return 6 * component.size() != 12 + halfEdges;  // V - E + T = 2 without
}

}  // namespace

bool roundOffDrops(EditableMesh& mesh, const LevelSet& phi, const std::vector<std::uint32_t>& among) {
  const EditableMesh unit = unitBall();
  bool any = false;
  for (std::uint32_t start : among) {
    if (mesh.outgoing[start] == kNone) continue;
    const std::vector<std::uint32_t> drop = smallComponent(mesh, start);
    if (drop.empty() || hasHandle(mesh, drop)) continue;
    const auto count = double(drop.size());
    Vec3d middle(0.0);
    for (std::uint32_t v : drop) middle += Vec3d(mesh.position[v]) / count;
    double radius = 0.0;
    for (std::uint32_t v : drop) radius += (Vec3d(mesh.position[v]) - middle).length() / count;
    EditableMesh ball = unit;
    for (Vec3f& p : ball.position) p = Vec3f(middle + Vec3d(p) * radius);
    if (phi.scaled()) ball.scale.assign(kBallVertices, phi.scale(Vec3f(middle)));
    mesh.removeComponent(drop);
    mesh.append(ball);
    any = true;
  }
  return any;
}

}  // namespace fluidtex::texture
