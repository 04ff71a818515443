#include "texture/mesh/mesh_stats.h"

#include "texture/mesh/editable_mesh.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace fluidtex::texture {
namespace {

using openvdb::Vec3d;

int foldedEdges(const std::vector<Vec3f>& positions, const std::vector<Vec3I>& triangles) {
  // The edges that start at each vertex: where they end, and their triangles.
  std::vector<std::uint32_t> first(positions.size() + 1, 0);
  for (const Vec3I& t : triangles)
    for (int k = 0; k < 3; ++k) ++first[t[k] + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  struct Edge {
    std::uint32_t end, triangle;
  };
  std::vector<Edge> edges(3 * triangles.size());
  std::vector<std::uint32_t> cursor(first.begin(), first.end() - 1);
  std::vector<Vec3d> normals;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const Vec3I& corner = triangles[t];
    for (int k = 0; k < 3; ++k) edges[cursor[corner[k]]++] = {corner[(k + 1) % 3], t};
    const Vec3d a(positions[corner[0]]);
    normals.push_back((Vec3d(positions[corner[1]]) - a).cross(Vec3d(positions[corner[2]]) - a));
  }
  int folded = 0;
  for (std::uint32_t a = 0; a < positions.size(); ++a)
    for (std::uint32_t i = first[a]; i < first[a + 1]; ++i) {
      const std::uint32_t b = edges[i].end;
      if (b < a) continue;
      for (std::uint32_t k = first[b]; k < first[b + 1]; ++k)
        if (edges[k].end == a && normals[edges[i].triangle].dot(normals[edges[k].triangle]) < 0.0) ++folded;
    }
  return folded;
}

int spikesOf(const std::vector<Vec3f>& positions, const std::vector<Vec3I>& triangles,
             const std::vector<Vec3f>& normals) {
  struct Sum {
    Vec3d toNeighbors{0.0};
    double length = 0.0;
  };
  std::vector<Sum> sums(positions.size());
  for (const Vec3I& t : triangles)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      const Vec3d way = Vec3d(positions[b]) - Vec3d(positions[a]);
      sums[a].toNeighbors += way;
      sums[b].toNeighbors -= way;
      sums[a].length += way.length();
      sums[b].length += way.length();
    }
  int spikes = 0;
  for (std::size_t v = 0; v < normals.size(); ++v)
    spikes += std::abs(sums[v].toNeighbors.dot(Vec3d(normals[v]))) > 0.5 * sums[v].length;
  return spikes;
}

}  // namespace

MeshStats meshStats(const std::vector<Vec3f>& positions, const std::vector<Vec3I>& triangles,
                    const std::vector<Vec3f>& normals) {
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
  stats.folded = foldedEdges(positions, triangles);
  stats.spikes = spikesOf(positions, triangles, normals);
  return stats;
}

}  // namespace fluidtex::texture
