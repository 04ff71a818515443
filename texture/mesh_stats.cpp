#include "texture/mesh_stats.h"

#include <cmath>
#include <numeric>

namespace fluidtex::texture {
namespace {

int countComponents(std::size_t vertices, const std::vector<Vec3I>& triangles) {
  std::vector<std::uint32_t> parent(vertices);
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  int components = static_cast<int>(vertices);
  for (const auto& triangle : triangles)
    for (int corner = 1; corner < 3; ++corner) {
      const std::uint32_t a = root(triangle[0]), b = root(triangle[corner]);
      if (a == b) continue;
      parent[b] = a;
      --components;
    }
  return components;
}

}  // namespace

MeshStats meshStats(const std::vector<Vec3f>& positions, const std::vector<Vec3I>& triangles) {
  MeshStats stats;
  if (triangles.empty()) return stats;
  stats.components = countComponents(positions.size(), triangles);
  double sum = 0.0, squares = 0.0;
  for (const auto& triangle : triangles)
    for (int corner = 0; corner < 3; ++corner) {
      const double length = (positions[triangle[corner]] - positions[triangle[(corner + 1) % 3]]).length();
      sum += length;
      squares += length * length;
    }
  const double count = 3.0 * static_cast<double>(triangles.size());
  stats.edgeMean = sum / count;
  const double variance = std::max(0.0, squares / count - stats.edgeMean * stats.edgeMean);
  stats.edgeCv = stats.edgeMean > 0.0 ? std::sqrt(variance) / stats.edgeMean : 0.0;
  return stats;
}

}  // namespace fluidtex::texture
