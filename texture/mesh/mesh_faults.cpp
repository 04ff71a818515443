#include "texture/mesh/mesh_faults.h"

#include "texture/loops/parallel.h"

#include <cmath>

namespace fluidtex::texture {
namespace {

using openvdb::Vec3d;

// Twice the area long.
Vec3d areaNormal(const EditableMesh& mesh, std::uint32_t h) {
  const Vec3d a(mesh.position[mesh.origin[h]]);
  return (Vec3d(mesh.position[mesh.target(h)]) - a).cross(Vec3d(mesh.position[mesh.opposite(h)]) - a);
}

void find(const EditableMesh& mesh, std::uint32_t v, Faults& faults) {
  if (mesh.outgoing[v] == kNone) return;
  mesh.around(v, [&](std::uint32_t h) {
    if (v < mesh.target(h) && turn(mesh, h) < kFolded) faults.folds.push_back(h);
  });
  if (sticksOut(mesh, v)) faults.spikes.push_back(v);
}

}  // namespace

Vec3f meshNormal(const EditableMesh& mesh, std::uint32_t v) {
  Vec3d sum(0.0);
  mesh.around(v, [&](std::uint32_t h) { sum += areaNormal(mesh, h); });
  return sum.normalize() ? Vec3f(sum) : Vec3f(0.0f);
}

Vec3f normalAt(const EditableMesh& mesh, std::uint32_t v) {
  constexpr float kAgree = 0.8f;  // cosine
  const Vec3f own = meshNormal(mesh, v);
  if (mesh.normal[v].lengthSqr() > 0.5f && mesh.normal[v].dot(own) > kAgree) return mesh.normal[v];
  return own.lengthSqr() > 0.5f ? own : Vec3f(0.0f, 0.0f, 1.0f);
}

Ring ringOf(const EditableMesh& mesh, std::uint32_t v) {
  Ring ring;
  const Vec3d here(mesh.position[v]);
  mesh.around(v, [&](std::uint32_t h) {
    const Vec3d way = Vec3d(mesh.position[mesh.target(h)]) - here;
    ring.toMean += way;
    ring.edge += way.length();
    ++ring.count;
  });
  ring.toMean /= ring.count;
  ring.edge /= ring.count;
  return ring;
}

double turn(const EditableMesh& mesh, std::uint32_t h) {
  const Vec3d a = areaNormal(mesh, h), b = areaNormal(mesh, mesh.twin[h]);
  const double lengths2 = a.lengthSqr() * b.lengthSqr();
  return lengths2 > 0.0 ? a.dot(b) / std::sqrt(lengths2) : -1.0;
}

bool sticksOut(const EditableMesh& mesh, std::uint32_t v) {
  const Ring ring = ringOf(mesh, v);
  const double limit = kSpike * ring.edge;
  if (ring.toMean.lengthSqr() <= limit * limit) return false;
  return std::abs(ring.toMean.dot(Vec3d(meshNormal(mesh, v)))) > limit ||
         std::abs(ring.toMean.dot(Vec3d(normalAt(mesh, v)))) > limit;
}

Faults faultsAt(const EditableMesh& mesh, const std::vector<std::uint32_t>& vertices) {
  Faults faults;
  for (std::uint32_t v : vertices) find(mesh, v, faults);
  return faults;
}

Faults faultsOf(const EditableMesh& mesh) {
  using Vertices = std::vector<std::uint32_t>;
  return faultsAt(mesh, gathered<std::uint32_t>(mesh.vertexCount(), [&](std::uint32_t v, Vertices& found) {
                    Faults faults;
                    find(mesh, v, faults);
                    if (!faults.none()) found.push_back(v);
                  }));
}

}  // namespace fluidtex::texture
