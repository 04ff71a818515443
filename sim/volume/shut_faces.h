// Shut faces that the volume deficit does not pass.
#pragma once

#include "sim/grid/leaf_patch.h"
#include "sim/grid/leaf_table.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace fluidtex::sim {

// The neighbour of a cell in a patch on a side (0 to 5: -x, +x, -y, ...).
inline int besideIn(int at, int side) {
  const int stride = kPatchStride[side / 2];
  return side % 2 == 0 ? at - stride : at + stride;
}

// Shut faces between two cells that both have room, as in a thin wall: no deficit passes there. A bit for
// each side of each cell of a leaf; null for most leaves, which have none.
using ShutSides = std::array<std::uint8_t, kLeafSize>;
using ShutFaces = std::vector<std::unique_ptr<ShutSides>>;

// room: #voxels of `leaves`, open share of each cell; 0 beyond them. open: open area fractions of faces.
ShutFaces shutFaces(const LeafTable& leaves, const std::vector<float>& room, const FaceGrids& open);

// Calls body(offset, sum) for the cells of a leaf that have a shut side. sum(flow): of flow(at, beside), with
// patch indices, over a cell's other sides.
template <class Body>
void forCellsBesideShut(const ShutFaces& shut, std::size_t leaf, const Body& body) {
  if (shut[leaf] == nullptr) return;
  for (int i = 0; i < kLeafSize; ++i) {
    const int sides = (*shut[leaf])[i], at = patchIndex(i);
    if (sides == 0) continue;
    body(i, [&](const auto& flow) {
      float sum = 0.0f;
      for (int side = 0; side < 6; ++side)
        if ((sides >> side & 1) == 0) sum += flow(at, besideIn(at, side));
      return sum;
    });
  }
}

}  // namespace fluidtex::sim
