// A triangle mesh as CGAL has it. For files that are compiled with CGAL alone.
#pragma once

#include "texture/surface.h"

#include <CGAL/Surface_mesh.h>

#include <vector>

namespace fluidtex::benchmarks {

template <typename Point>
CGAL::Surface_mesh<Point> cgalMesh(const std::vector<texture::Vec3f>& positions,
                                   const std::vector<texture::Vec3I>& triangles) {
  using Mesh = CGAL::Surface_mesh<Point>;
  Mesh mesh;
  std::vector<typename Mesh::Vertex_index> vertex;
  vertex.reserve(positions.size());
  for (const texture::Vec3f& p : positions) vertex.push_back(mesh.add_vertex(Point(p.x(), p.y(), p.z())));
  for (const texture::Vec3I& t : triangles) mesh.add_face(vertex[t[0]], vertex[t[1]], vertex[t[2]]);
  return mesh;
}

}  // namespace fluidtex::benchmarks
