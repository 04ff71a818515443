// Connected components of a masked surface.
#pragma once

#include "texture/mesh/vertex_graph.h"

#include <cstdint>
#include <vector>

namespace fluidtex::texture {

// Calls body(piece) for each connected component of the mask (#V) over half-edges h of vertices v with
// joined(v, h), which must be symmetric. Components come in the order of their first vertex, their vertices
// in breadth-first order from it.
template <typename Joined, typename Body>
void forEachPiece(const VertexGraph& graph, const std::vector<std::uint8_t>& mask, const Joined& joined,
                  const Body& body) {
  std::vector<std::uint8_t> seen(mask.size(), 0);
  std::vector<std::uint32_t> piece;
  for (std::uint32_t start = 0; start < mask.size(); ++start) {
    if (!mask[start] || seen[start]) continue;
    piece.assign(1, start);
    seen[start] = 1;
    for (std::size_t i = 0; i < piece.size(); ++i) {
      const std::uint32_t v = piece[i];
      for (std::uint32_t h = graph.first[v]; h < graph.first[v + 1]; ++h) {
        const std::uint32_t u = graph.neighbor[h];
        if (!mask[u] || seen[u] || !joined(v, h)) continue;
        seen[u] = 1;
        piece.push_back(u);
      }
    }
    body(piece);
  }
}

// The same with all half-edges joined.
template <typename Body>
void forEachPiece(const VertexGraph& graph, const std::vector<std::uint8_t>& mask, const Body& body) {
  forEachPiece(
      graph, mask, [](std::uint32_t, std::uint32_t) { return true; }, body);
}

}  // namespace fluidtex::texture
