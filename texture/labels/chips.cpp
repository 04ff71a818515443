#include "texture/labels/chips.h"

#include "texture/labels/fresh.h"
#include "texture/labels/pieces.h"
#include "texture/loops/parallel.h"

#include <algorithm>

namespace fluidtex::texture {

void absorbChips(const SeamModel& model, const std::vector<std::uint8_t>& free, Labels& labels) {
  const VertexGraph& graph = model.view.graph;
  const std::size_t count = labels.size();
  std::vector<std::uint8_t> joined(graph.neighbor.size(), 0);
  forEachIndex(count, [&](std::uint32_t v) {
    if (!free[v]) return;
    for (std::uint32_t h = graph.first[v]; h < graph.first[v + 1]; ++h)
      joined[h] = continues(model, labels[v], labels[graph.neighbor[h]], h);
  });
  const auto isJoined = [&](std::uint32_t, std::uint32_t h) { return joined[h] != 0; };
  const auto isFree = [&](std::uint32_t v) {  // and so are the neighbours it continues to
    for (std::uint32_t h = graph.first[v]; h < graph.first[v + 1]; ++h)
      if (joined[h] && !free[graph.neighbor[h]]) return false;
    return true;
  };
  std::vector<std::uint8_t> chips(count, 0);
  forEachPiece(graph, free, isJoined, [&](const std::vector<std::uint32_t>& piece) {
    if (piece.size() >= kChip || !std::all_of(piece.begin(), piece.end(), isFree)) return;
    for (const std::uint32_t v : piece) chips[v] = 1;
  });
  if (!any(chips)) return;

  std::vector<std::uint8_t> rest(count);
  for (std::size_t v = 0; v < count; ++v) rest[v] = !chips[v];
  handOn(model.image, model.view, chips, std::move(rest), labels, HandOn::inside);
}

}  // namespace fluidtex::texture
