// Which vertices of a mesh are joined by an edge: the one-ring of each.
#pragma once

#include "texture/surface.h"

#include <span>

namespace fluidtex::texture {

// One-rings in compressed rows: the neighbours of v are neighbor[first[v]] .. neighbor[first[v+1]-1],
// counter-clockwise seen from outside (the angle in (d, b) falls).
struct VertexGraph {
  std::vector<std::uint32_t> first;     // #V + 1
  std::vector<std::uint32_t> neighbor;  // #H, directed edges
  std::span<const std::uint32_t> around(std::uint32_t v) const {
    return {neighbor.data() + first[v], neighbor.data() + first[v + 1]};
  }
};

// Throws std::invalid_argument if the mesh is not closed and manifold.
VertexGraph buildVertexGraph(const SurfaceMesh& mesh);

}  // namespace fluidtex::texture
