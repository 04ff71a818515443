#include "texture/mesh_stats.h"

#include "texture/editable_mesh.h"

#include <algorithm>
#include <cmath>

namespace fluidtex::texture {
MeshStats meshStats(const std::vector<Vec3f>& positions, const std::vector<Vec3I>& triangles) {
  MeshStats stats;
  if (triangles.empty()) return stats;
  const std::vector<std::uint32_t> component = components(positions.size(), triangles);
  for (std::uint32_t v = 0; v < component.size(); ++v) stats.components += component[v] == v;
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
