#include "texture/mesh/mend.h"

#include "mesh_quality.h"
#include "tests/texture/levelset/level_sets.h"
#include "texture/mesh/connect.h"
#include "texture/mesh/points.h"
#include "texture/mesh/remesh.h"

#include <catch2/catch.hpp>

using namespace fluidtex::texture;

namespace {

SurfaceMesh asSurface(EditableMesh mesh) {
  mesh.compact(mesh.vertexCount());
  SurfaceMesh surface;
  surface.positions = mesh.position;
  surface.normals = mesh.normal;
  surface.triangles = trianglesOf(mesh);
  return surface;
}

}  // namespace

TEST_CASE("mend: vertices pushed over their neighbours and off the surface come back") {
  const auto grid = sphereGrid(12.0, 1.0, Vec3d(0.3, 0.1, 0.2));  // index space is world space
  const LevelSet phi(*grid);
  const IsoSurface surface = isoSurface(phi);
  EditableMesh mesh = connectPoints(phi, surface, spreadPoints(phi, surface, {}, 1.0f, 1), 1.0f);
  mend(mesh, phi, 1.0f);
  const std::size_t before = mesh.vertexCount();
  for (std::uint32_t v = 0; v < before; v += 40) {
    if (mesh.outgoing[v] == kNone) continue;
    const Vec3f u = mesh.position[mesh.target(mesh.outgoing[v])];
    mesh.position[v] += (u - mesh.position[v]) * 2.0f + mesh.normal[v] * 0.8f;
  }
  const Quality broken = measure(asSurface(mesh), *grid);
  CHECK(broken.folded > 10);
  CHECK(broken.worstDistance > 0.5);
  mend(mesh, phi, 1.0f);
  const SurfaceMesh mended = asSurface(mesh);
  REQUIRE(isClosedManifold(mended.positions.size(), mended.triangles));
  const Quality q = measure(mended, *grid);
  CHECK(q.folded == 0);
  CHECK(q.slim == 0.0);
  CHECK(q.worstDistance < 0.5);
}

TEST_CASE("mend: leaves a good mesh alone") {
  const auto grid = torusGrid(20.0, 8.0, 1.0);
  const LevelSet phi(*grid);
  const IsoSurface surface = isoSurface(phi);
  EditableMesh mesh = connectPoints(phi, surface, spreadPoints(phi, surface, {}, 1.0f, 1), 1.0f);
  evenOut(mesh, phi, {1.0f, area(surface.positions, surface.triangles), 16, false});
  const std::vector<Vec3f> positions = mesh.position;
  const std::vector<std::uint32_t> origin = mesh.origin;
  mend(mesh, phi, 1.0f);
  CHECK(mesh.position == positions);
  CHECK(mesh.origin == origin);
}
