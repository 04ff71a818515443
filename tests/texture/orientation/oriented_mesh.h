// A mesh with graph and connection, for tests of what works on them.
#pragma once

#include "tests/texture/mesh/closed_meshes.h"
#include "texture/neighborhood/neighborhood.h"

namespace fluidtex::testing {

struct OrientedMesh {
  texture::SurfaceMesh mesh;
  texture::VertexGraph graph;
  texture::Connection connection;
  texture::MeshView view() const { return {mesh, graph, connection}; }
};

// Keeps mesh.orientation where it has one, else takes the reference vectors.
inline OrientedMesh orientedMesh(texture::SurfaceMesh mesh) {
  OrientedMesh result{std::move(mesh), {}, {}};
  if (result.mesh.orientation.empty())
    result.mesh.orientation = texture::referenceVectors(result.mesh.normals);
  result.graph = texture::buildVertexGraph(result.mesh);
  result.connection = texture::buildConnection(result.mesh, result.graph, result.mesh.orientation);
  return result;
}

// A flat box of `cells` x `cells` unit squares: its upper side is a plane, of which one vertex is one pixel;
// columns run along x, rows along -y.
inline OrientedMesh flatBox(int cells) {
  texture::SurfaceMesh mesh = boxMesh({0, 0, 0}, {double(cells), double(cells), 2}, {cells, cells, 2});
  mesh.spacing = 1.0;
  return orientedMesh(std::move(mesh));
}

inline std::uint32_t nearestVertex(const texture::SurfaceMesh& mesh, const texture::Vec3f& x) {
  std::uint32_t best = 0;
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v)
    if ((mesh.positions[v] - x).lengthSqr() < (mesh.positions[best] - x).lengthSqr()) best = v;
  return best;
}

}  // namespace fluidtex::testing
