#include "texture/mesh/vertex_graph.h"

#include "texture/loops/parallel.h"

#include <stdexcept>
#include <string>

namespace fluidtex::texture {
namespace {

[[noreturn]] void throwNotManifold(std::size_t v) {
  throw std::invalid_argument("mesh is not closed and manifold at vertex " + std::to_string(v));
}

// The two other corners of a triangle at a vertex, in the triangle's order.
struct Corner {
  std::uint32_t from, to;
};

// Orders the corners around a vertex, each beginning where the last ends. False if they do not close to one
// ring.
bool chain(std::span<Corner> corners) {
  const std::size_t count = corners.size();
  if (count < 3) return false;
  for (std::size_t i = 1; i < count; ++i) {
    std::size_t j = i;
    while (j < count && corners[j].from != corners[i - 1].to) ++j;
    if (j == count) return false;
    std::swap(corners[i], corners[j]);
    if (corners[i].to == corners[0].from && i + 1 < count) return false;  // closed early: two fans
  }
  return corners[count - 1].to == corners[0].from;
}

}  // namespace

VertexGraph buildVertexGraph(const SurfaceMesh& mesh) {
  const std::size_t vertexCount = mesh.positions.size();
  VertexGraph graph;
  graph.first.assign(vertexCount + 1, 0);
  for (const Vec3I& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      if (t[i] >= vertexCount) throw std::invalid_argument("mesh has a triangle whose vertex does not exist");
      ++graph.first[t[i] + 1];
    }
  }
  for (std::size_t v = 0; v < vertexCount; ++v) graph.first[v + 1] += graph.first[v];

  std::vector<Corner> corners(3 * mesh.triangles.size());
  std::vector<std::uint32_t> next(graph.first.begin(), graph.first.end() - 1);
  for (const Vec3I& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) corners[next[t[i]]++] = {t[(i + 1) % 3], t[(i + 2) % 3]};
  }

  graph.neighbor.resize(corners.size());
  std::vector<std::uint8_t> faulty(vertexCount, 0);
  forEachIndex(vertexCount, [&](std::uint32_t v) {
    const std::span<Corner> ring(corners.data() + graph.first[v], corners.data() + graph.first[v + 1]);
    if (!chain(ring)) faulty[v] = 1;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      if (ring[i].from == v) faulty[v] = 1;
      graph.neighbor[graph.first[v] + i] = ring[i].from;
    }
  });
  for (std::size_t v = 0; v < vertexCount; ++v) {
    if (faulty[v]) throwNotManifold(v);
  }
  return graph;
}

}  // namespace fluidtex::texture
