// A small closed mesh to edit.
#pragma once

#include "texture/mesh/editable_mesh.h"

namespace fluidtex::texture {

// Twelve vertices, edges of length 2, normals outward.
inline EditableMesh icosahedron() {
  const float g = 1.618034f;
  std::vector<Vec3f> p{{0, 1, g},  {0, -1, g},  {0, 1, -g}, {0, -1, -g}, {1, g, 0},  {-1, g, 0},
                       {1, -g, 0}, {-1, -g, 0}, {g, 0, 1},  {-g, 0, 1},  {g, 0, -1}, {-g, 0, -1}};
  std::vector<Vec3I> triangles;
  for (std::uint32_t a = 0; a < 12; ++a) {
    for (std::uint32_t b = a + 1; b < 12; ++b) {
      for (std::uint32_t c = b + 1; c < 12; ++c) {
        const auto near = [&](std::uint32_t i, std::uint32_t j) { return (p[i] - p[j]).lengthSqr() < 4.1f; };
        if (!near(a, b) || !near(b, c) || !near(c, a)) continue;
        const bool outward = (p[b] - p[a]).cross(p[c] - p[a]).dot(p[a]) > 0.0f;
        triangles.push_back(outward ? Vec3I(a, b, c) : Vec3I(a, c, b));
      }
    }
  }
  EditableMesh mesh = makeEditableMesh(p, triangles);
  for (std::size_t v = 0; v < p.size(); ++v) mesh.normal[v] = p[v].unit();
  return mesh;
}

}  // namespace fluidtex::texture
