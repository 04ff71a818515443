#include "sim/solids/chunks.h"

#include "sim/grid/leaf_table.h"

#include <algorithm>

namespace fluidtex::sim {
namespace {

Coord chunkOf(const Coord& cell) {
  constexpr int kMask = ~(kChunkDim - 1);
  return Coord(cell[0] & kMask, cell[1] & kMask, cell[2] & kMask);
}

void sortOnce(Chunks& chunks) {
  std::sort(chunks.begin(), chunks.end());
  chunks.erase(std::unique(chunks.begin(), chunks.end()), chunks.end());
}

}  // namespace

Chunks chunksIn(const CoordBBox& box) {
  Chunks chunks;
  const Coord first = chunkOf(box.min());
  for (int i = first[0]; i <= box.max()[0]; i += kChunkDim)
    for (int j = first[1]; j <= box.max()[1]; j += kChunkDim)
      for (int k = first[2]; k <= box.max()[2]; k += kChunkDim) chunks.emplace_back(i, j, k);
  return chunks;
}

Chunks chunksAround(const std::vector<const FloatGrid*>& phis, int reach, const CoordBBox& box) {
  Chunks wet;
  for (const FloatGrid* phi : phis) {
    for (const Coord& origin : wetLeaves(*phi, CoordBBox::inf())) {
      const Coord chunk = chunkOf(origin);
      if (wet.empty() || wet.back() != chunk) wet.push_back(chunk);
    }
  }
  sortOnce(wet);
  Chunks around;
  for (const Coord& chunk : wet) {
    CoordBBox near = CoordBBox::createCube(chunk, kChunkDim);
    near.expand(reach * kChunkDim);
    near.intersect(box);
    if (near.empty()) continue;
    const Chunks there = chunksIn(near);
    around.insert(around.end(), there.begin(), there.end());
  }
  sortOnce(around);
  return around;
}

Chunks united(Chunks a, const Chunks& b) {
  a.insert(a.end(), b.begin(), b.end());
  sortOnce(a);
  return a;
}

bool covers(const Chunks& all, const Chunks& some) {
  return std::includes(all.begin(), all.end(), some.begin(), some.end());
}

}  // namespace fluidtex::sim
