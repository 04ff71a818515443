#include "texture/labels/fresh.h"

#include "texture/labels/labels.h"
#include "texture/labels/pieces.h"
#include "texture/loops/parallel.h"

#include <algorithm>
#include <limits>

namespace fluidtex::texture {
namespace {

// #V: edges to the nearest vertex outside the mask; kNone where there is none.
std::vector<std::uint32_t> depths(const VertexGraph& graph, const std::vector<std::uint8_t>& mask) {
  std::vector<std::uint32_t> depth(mask.size(), kNone), queue;
  for (std::uint32_t v = 0; v < mask.size(); ++v) {
    if (mask[v]) continue;
    depth[v] = 0;
    queue.push_back(v);
  }
  for (std::size_t i = 0; i < queue.size(); ++i) {
    for (const std::uint32_t u : graph.around(queue[i])) {
      if (depth[u] != kNone) continue;
      depth[u] = depth[queue[i]] + 1;
      queue.push_back(u);
    }
  }
  return depth;
}

}  // namespace

std::vector<std::uint8_t> freshVertices(const std::vector<float>& trust) {
  std::vector<std::uint8_t> fresh(trust.size());
  forEachIndex(trust.size(), [&](std::uint32_t v) { fresh[v] = trust[v] < kLowTrust; });
  return fresh;
}

std::vector<std::uint8_t> wideFresh(const VertexGraph& graph, const std::vector<std::uint8_t>& fresh,
                                    int window) {
  std::vector<std::uint8_t> wide(fresh.size(), 0);
  if (!any(fresh)) return wide;
  const std::vector<std::uint32_t> depth = depths(graph, fresh);
  const auto half = std::uint32_t(window / 2);
  const std::size_t pixels = std::size_t(window) * std::size_t(window);
  forEachPiece(graph, fresh, [&](const std::vector<std::uint32_t>& piece) {
    const bool rimless = depth[piece.front()] == kNone;
    const bool fits =
        rimless ? piece.size() >= pixels
                : std::any_of(piece.begin(), piece.end(), [&](std::uint32_t v) { return depth[v] >= half; });
    if (!fits) return;
    for (const std::uint32_t v : piece) wide[v] = 1;
  });
  return wide;
}

std::vector<std::uint8_t> droplets(const VertexGraph& graph, int window) {
  const std::size_t count = graph.first.size() - 1, pixels = std::size_t(window) * std::size_t(window);
  std::vector<std::uint8_t> small(count, 0);
  forEachPiece(graph, std::vector<std::uint8_t>(count, 1), [&](const std::vector<std::uint32_t>& piece) {
    if (piece.size() >= pixels) return;
    for (const std::uint32_t v : piece) small[v] = 1;
  });
  return small;
}

void calmDroplets(const SurfaceMesh& mesh, const std::vector<std::uint8_t>& droplets, const Ways& ways,
                  Carried& carried) {
  if (carried.empty()) return;
  forEachIndex(droplets.size(), [&](std::uint32_t v) {
    if (!droplets[v]) return;
    const Label drawnOut = labelOf(mesh, v, carried.coordinate[v], carried.gradient[v]);
    carried.gradient[v] = gradientOf(unstretched(drawnOut.texel, layOf(drawnOut, ways)), mesh.orientation[v],
                                     mesh.normals[v], mesh.spacingAt(v));
  });
}

bool any(const std::vector<std::uint8_t>& mask) {
  return std::find_if(mask.begin(), mask.end(), [](std::uint8_t m) { return m != 0; }) != mask.end();
}

}  // namespace fluidtex::texture
