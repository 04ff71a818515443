// Diffusion of values over the surface.
#pragma once

#include "texture/loops/parallel.h"
#include "texture/mesh/vertex_graph.h"

#include <vector>

namespace fluidtex::texture {

// `sweeps` times, each vertex takes the mean of its own value (#V) and its neighbours': a window of standard
// deviation about 0.65 sqrt(sweeps) edges. brought(value, h): a neighbour's value, transported over half-edge
// h.
template <typename Value, typename Brought>
std::vector<Value> averaged(const VertexGraph& graph, std::vector<Value> value, int sweeps,
                            const Brought& brought) {
  std::vector<Value> next(value.size());
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    forEachIndex(value.size(), [&](std::uint32_t v) {
      Value sum = value[v];
      const std::uint32_t end = graph.first[v + 1];
      for (std::uint32_t h = graph.first[v]; h < end; ++h) sum += brought(value[graph.neighbor[h]], h);
      next[v] = sum * (1.0f / float(end - graph.first[v] + 1));
    });
    value.swap(next);
  }
  return value;
}

}  // namespace fluidtex::texture
