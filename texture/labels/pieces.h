// Connected pieces of a surface.
#pragma once

#include "texture/orientation/tangent.h"

#include <cstdint>
#include <vector>

namespace fluidtex::texture {

// Calls body(piece) with the vertices of every piece of the mask (#V) that hangs together over half-edges h
// for which joined(h), the same both ways, holds: pieces by their first vertex, each from there outwards.
template <typename Joined, typename Body>
void forEachPiece(const VertexGraph& graph, const std::vector<std::uint8_t>& mask, const Joined& joined,
                  const Body& body) {
  std::vector<std::uint8_t> seen(mask.size(), 0);
  std::vector<std::uint32_t> piece;
  for (std::uint32_t start = 0; start < mask.size(); ++start) {
    if (!mask[start] || seen[start]) continue;
    piece.assign(1, start);
    seen[start] = 1;
    for (std::size_t i = 0; i < piece.size(); ++i)
      for (std::uint32_t h = graph.first[piece[i]]; h < graph.first[piece[i] + 1]; ++h) {
        const std::uint32_t u = graph.neighbor[h];
        if (!mask[u] || seen[u] || !joined(h)) continue;
        seen[u] = 1;
        piece.push_back(u);
      }
    body(piece);
  }
}

// The same over all half-edges.
template <typename Body>
void forEachPiece(const VertexGraph& graph, const std::vector<std::uint8_t>& mask, const Body& body) {
  forEachPiece(
      graph, mask, [](std::uint32_t) { return true; }, body);
}

}  // namespace fluidtex::texture
