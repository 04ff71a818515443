#include "texture/mesh/mesh_faults.h"

#include "tests/texture/mesh/icosahedron.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex::texture;

TEST_CASE("mesh faults: normals, rings and turns of an icosahedron") {
  const EditableMesh mesh = icosahedron();
  for (std::uint32_t v = 0; v < 12; ++v) {
    CHECK((meshNormal(mesh, v) - mesh.position[v].unit()).length() < 1e-5f);
    const Ring ring = ringOf(mesh, v);
    CHECK(ring.count == 5);
    CHECK(ring.edge == Approx(2.0).epsilon(1e-5));
    // The mean of the neighbours lies straight below.
    CHECK(ring.toMean.cross(openvdb::Vec3d(mesh.position[v])).length() < 1e-4);
    CHECK(ring.toMean.dot(openvdb::Vec3d(mesh.position[v])) < 0.0);
  }
  // The dihedral angle's cosine is -sqrt(5) / 3; that of the normals is its negative.
  for (std::uint32_t h = 0; h < mesh.halfEdgeCount(); ++h)
    CHECK(turn(mesh, h) == Approx(std::sqrt(5.0) / 3.0).epsilon(1e-4));
}

TEST_CASE("mesh faults: a vertex pulled out is a spike, one pushed through folds edges") {
  EditableMesh mesh = icosahedron();
  // Each vertex of an icosahedron sticks out of its ring, by 0.53 of the edge; here nearly in its plane.
  CHECK(faultsOf(mesh).folds.empty());
  const openvdb::Vec3d toMean = ringOf(mesh, 3).toMean;
  mesh.position[3] += Vec3f(0.9 * toMean);
  CHECK_FALSE(sticksOut(mesh, 3));
  mesh.position[3] -= Vec3f(5.0 * toMean);
  CHECK(sticksOut(mesh, 3));
  const Faults faults = faultsAt(mesh, {3});
  CHECK(faults.spikes == std::vector<std::uint32_t>{3});
  CHECK_FALSE(faults.none());
  mesh = icosahedron();
  // Beyond its neighbour: two of its triangles lie over others.
  const std::uint32_t u = mesh.target(mesh.outgoing[3]);
  mesh.position[3] += (mesh.position[u] - mesh.position[3]) * 2.0f;
  CHECK_FALSE(faultsOf(mesh).folds.empty());
}

TEST_CASE("mesh faults: the level set's normal counts where it agrees with the mesh's") {
  EditableMesh mesh = icosahedron();
  const Vec3f own = meshNormal(mesh, 0);
  const Vec3f beside = (own + 0.3f * Vec3f(own.y(), -own.x(), 0.0f)).unit();
  mesh.normal[0] = beside;
  CHECK(normalAt(mesh, 0) == beside);
  mesh.normal[0] = -own;
  CHECK(normalAt(mesh, 0) == own);
  mesh.normal[0] = Vec3f(0.0f);
  CHECK(normalAt(mesh, 0) == own);
}
