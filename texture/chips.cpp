#include "texture/chips.h"

#include "texture/parallel.h"

namespace fluidtex::texture {

void absorbChips(const SeamModel& model, const std::vector<std::uint8_t>& free, Labels& labels,
                 std::vector<std::uint8_t>& changed) {
  const VertexGraph& graph = model.view.graph;
  const std::size_t count = labels.size();
  std::vector<std::uint8_t> joined(graph.neighbor.size());
  forEachIndex(count, [&](std::uint32_t v) {
    for (std::uint32_t h = graph.first[v]; h < graph.first[v + 1]; ++h)
      joined[h] = continues(model, labels[v], labels[graph.neighbor[h]], h);
  });

  std::vector<std::uint8_t> seen(count, 0), chips(count, 0);
  std::vector<std::uint32_t> piece;
  for (std::uint32_t start = 0; start < count; ++start) {
    if (seen[start] || !free[start]) continue;
    piece.assign(1, start);
    seen[start] = 1;
    bool whole = true;  // all of it is free
    for (std::size_t i = 0; i < piece.size(); ++i)
      for (std::uint32_t h = graph.first[piece[i]]; h < graph.first[piece[i] + 1]; ++h) {
        const std::uint32_t u = graph.neighbor[h];
        if (!joined[h] || seen[u]) continue;
        if (!free[u]) {
          whole = false;
          continue;
        }
        seen[u] = 1;
        piece.push_back(u);
      }
    if (!whole || piece.size() >= kChip) continue;
    for (const std::uint32_t v : piece) chips[v] = 1;
  }

  std::vector<std::uint8_t> rest(count);
  for (std::size_t v = 0; v < count; ++v) rest[v] = !chips[v];
  const Labels before = labels;
  handOn(model.image, model.view, chips, std::move(rest), labels);
  for (std::size_t v = 0; v < count; ++v)
    if (chips[v] && (labels[v].texel != before[v].texel || labels[v].jacobian != before[v].jacobian))
      changed[v] = 1;
}

}  // namespace fluidtex::texture
