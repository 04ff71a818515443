#include "sim/volume/shut_faces.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace fluidtex::sim {

ShutFaces shutFaces(const LeafTable& leaves, const std::vector<float>& room, const FaceGrids& open) {
  ShutFaces shut(leaves.size());
  std::vector<char> isCut(leaves.size());  // solids take room in the leaf
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    const float* own = room.data() + n * kLeafSize;
    isCut[n] = std::any_of(own, own + kLeafSize, [](float r) { return r < 1.0f; });
  });
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    // A wall may begin in the plane between two leaves.
    const auto& next = leaves.next[n];
    if (!isCut[n] && std::none_of(next.begin(), next.end(), [&](int m) { return m >= 0 && isCut[m]; }))
      return;
    LeafPatch space{};
    loadPatch(leaves, room, n, space, [](float) { return 0.0f; });
    std::array<LeafPatch, 3> faces;
    for (int a = 0; a < 3; ++a) faces[a] = patchOf(open.component[a]->constTree(), leaves.origins[n]);
    ShutSides sides{};
    for (int i = 0; i < kLeafSize; ++i) {
      const int at = patchIndex(i);
      for (int side = 0; side < 6; ++side) {
        const int beside = besideIn(at, side);
        const bool isShut = faces[side / 2][std::max(at, beside)] <= 0.0f;
        if (isShut && space[at] > 0.0f && space[beside] > 0.0f) sides[i] |= std::uint8_t(1 << side);
      }
    }
    if (sides != ShutSides{}) shut[n] = std::make_unique<ShutSides>(sides);
  });
  return shut;
}

}  // namespace fluidtex::sim
