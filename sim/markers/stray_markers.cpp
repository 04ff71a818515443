#include "sim/markers/stray_markers.h"

#include "sim/grid/block_samples.h"
#include "sim/markers/marker_side.h"
#include "sim/markers/marker_sight.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace fluidtex::sim {
namespace {

// Distances here are in cells.
constexpr float kNear = 1.0f;      // markers this near have a vote
constexpr float kMajority = 2.0f;  // times as many votes against a marker as for it make it stray
constexpr int kGroup = 4;          // as many votes for a marker keep it
// A marker farther off than this is a drop or bubble of its own.
constexpr float kFarthest = 1.0f;
// The body of the marker's own side is that deep somewhere within kDepthReach cells of the marker's cell. A
// film or thread is nowhere.
constexpr float kDeep = 1.0f;
constexpr int kDepthReach = 2;
static_assert(kStrayHalo == kDepthReach + 1);

// Indices of a block's first `count` markers by cell.
struct CellOrder {
  std::array<std::uint32_t, kLeafSize + 1> start{};
  std::vector<std::uint32_t> order;

  CellOrder(const std::vector<Marker>& markers, std::size_t count) : order(count) {
    for (std::size_t n = 0; n < count; ++n) ++start[std::size_t(cellOf(markers[n])) + 1];
    for (std::size_t c = 0; c < kLeafSize; ++c) start[c + 1] += start[c];
    std::array<std::uint32_t, kLeafSize + 1> next = start;
    for (std::size_t n = 0; n < count; ++n) order[next[std::size_t(cellOf(markers[n]))]++] = std::uint32_t(n);
  }
};

// Of n = 0..26, with the block itself as 13.
Coord neighborOrigin(const Coord& origin, int n) {
  return origin.offsetBy(kLeafDim * (n / 9 - 1), kLeafDim * (n / 3 % 3 - 1), kLeafDim * (n % 3 - 1));
}

// The largest depth on the marker's own side around its cell.
float depthAround(const BlockSamples& distance, const Marker& m) {
  const float side = sideOf(m);
  float deepest = -kFarthest;
  for (int i = -kDepthReach; i <= 1 + kDepthReach; ++i) {
    for (int j = -kDepthReach; j <= 1 + kDepthReach; ++j) {
      const float* row = distance.sample(int(m.x) + i, int(m.y) + j, int(m.z) - kDepthReach);
      for (int k = 0; k < 2 * kDepthReach + 2; ++k) deepest = std::max(deepest, side * row[k]);
    }
  }
  return deepest;
}

// The markers around a block, by cell.
class Around {
 public:
  Around(const Markers& markers, const std::vector<std::unique_ptr<CellOrder>>& orders, const Coord& origin) {
    for (int n = 0; n < 27; ++n) {
      const MarkerBlock* block = findBlock(markers, neighborOrigin(origin, n));
      if (block != nullptr)
        m_blocks[std::size_t(n)] = {block, orders[std::size_t(block - markers.data())].get()};
    }
  }

  // Calls visit(marker) for all in a cell, with positions from the middle block's origin. Each of i, j, k in
  // [-1, 8].
  template <class Visit>
  void inCell(int i, int j, int k, const Visit& visit) const {
    const auto [block, order] = m_blocks[std::size_t((i + 8) / 8 * 9 + (j + 8) / 8 * 3 + (k + 8) / 8)];
    if (block == nullptr) return;
    const int cell = 64 * (i & 7) + 8 * (j & 7) + (k & 7);
    for (std::uint32_t n = order->start[std::size_t(cell)]; n < order->start[std::size_t(cell) + 1]; ++n) {
      Marker m = block->markers[order->order[n]];
      m.x += float(i - (i & 7)), m.y += float(j - (j & 7)), m.z += float(k - (k & 7));
      visit(m);
    }
  }

 private:
  std::array<std::pair<const MarkerBlock*, const CellOrder*>, 27> m_blocks{};
};

// Counts the markers between a marker and the surface, nearest cells first.
bool isOutvoted(const Marker& m, const BlockSamples& distance, const Around& around) {
  const float side = sideOf(m), here = side * distance.at(m.x, m.y, m.z);
  int with = -1, against = 0;  // it does not vote itself
  const auto count = [&](const Marker& other) {
    const float x = other.x - m.x, y = other.y - m.y, z = other.z - m.z;
    if (x * x + y * y + z * z > kNear * kNear) return;
    const float there = side * distance.at(other.x, other.y, other.z);
    if (there <= 0.0f && there >= here) ++(sideOf(other) == side ? with : against);
  };
  constexpr int kMiddle = 13;
  for (int n = 0; n < 27; ++n) {
    const int cell = (n + kMiddle) % 27;
    around.inCell(int(m.x) + cell / 9 - 1, int(m.y) + cell / 3 % 3 - 1, int(m.z) + cell % 3 - 1, count);
    if (with >= kGroup) return false;
  }
  return float(against) > kMajority * float(with) && against > 0;
}

}  // namespace

bool mayBeStray(const Marker& m, float phi, const BlockSamples& distance) {
  return std::abs(phi) <= kFarthest && depthAround(distance, m) >= kDeep;
}

void dropOutvoted(Markers& markers, std::vector<Suspects>& suspects, const FloatGrid& phi) {
  std::vector<char> asked(markers.size(), 0);
  for (std::size_t n = 0; n < markers.size(); ++n) {
    if (suspects[n].marker.empty()) continue;
    for (int neighbor = 0; neighbor < 27; ++neighbor) {
      const MarkerBlock* block = findBlock(markers, neighborOrigin(markers[n].origin, neighbor));
      if (block != nullptr) asked[std::size_t(block - markers.data())] = 1;
    }
  }
  std::vector<std::unique_ptr<CellOrder>> orders(markers.size());
  tbb::parallel_for(std::size_t{0}, markers.size(), [&](std::size_t n) {
    if (asked[n] != 0) orders[n] = std::make_unique<CellOrder>(markers[n].markers, suspects[n].voters);
  });
  tbb::parallel_for(std::size_t{0}, markers.size(), [&](std::size_t n) {
    if (suspects[n].marker.empty()) return;
    const Around around(markers, orders, markers[n].origin);
    thread_local BlockSamples distance(kStrayHalo);
    distance.load(phi.constTree(), markers[n].origin, 1.0f / static_cast<float>(phi.voxelSize()[0]));
    std::erase_if(suspects[n].marker,
                  [&](std::uint32_t m) { return !isOutvoted(markers[n].markers[m], distance, around); });
  });
  tbb::parallel_for(std::size_t{0}, markers.size(), [&](std::size_t n) {
    std::uint32_t number = 0;
    auto stray = suspects[n].marker.begin();
    std::erase_if(markers[n].markers, [&](const Marker&) {
      if (stray == suspects[n].marker.end() || number++ != *stray) return false;
      ++stray;
      return true;
    });
  });
}

}  // namespace fluidtex::sim
