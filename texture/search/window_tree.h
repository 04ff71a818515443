// A tree of descriptors by hierarchical clustering: two levels of k-means [Kwatra07 sec. V-B].
#pragma once

#include "texture/search/window_codes.h"

#include <cstdint>
#include <span>
#include <vector>

namespace fluidtex::texture {

// Leaf means in blocks of eight, component by component.
inline constexpr std::size_t kMeanBlock = 8;
using MeanBlocks = std::vector<float>;  // kMeanBlock x kDescriptorSize per block

inline constexpr std::uint32_t kNoWindow = 0xffffffffu;

struct WindowTree {
  std::vector<std::uint32_t> firstBlock;  // #leaves + 1
  // kCodeBlock per block: index of the descriptor; kNoWindow for padding in a leaf's last block, whose codes
  // are far from all others.
  std::vector<std::uint32_t> index;
  WindowCodes codes;  // in the order of index
  MeanBlocks leafMean;
  int leaves() const { return firstBlock.empty() ? 0 : int(firstBlock.size()) - 1; }
};

struct Found {
  float distance;       // squared
  std::uint32_t index;  // of the descriptor
  // Ascending distance, ties by index.
  friend bool operator<(const Found& a, const Found& b) {
    return a.distance < b.distance || (a.distance == b.distance && a.index < b.index);
  }
};

// Workspace of a search.
struct TreeSearch {
  std::vector<Found> leaf, best;
  std::vector<float> meanDistance;
  std::vector<Short16> coarse;
  std::vector<std::uint32_t> near;
};

// descriptors: #n x kDescriptorSize, n >= 1. About `leaves` leaves, fewer where n is small. No leaf is empty,
// and each descriptor is in the leaf of its nearest mean.
WindowTree buildWindowTree(std::span<const float> descriptors, int leaves, std::uint64_t seed);

// Writes to search.best, in ascending order, the `count` nearest descriptors in the `probes` leaves of
// nearest means. By their codes: of two whose distances differ by less than a hundredth of the range, the
// farther may be taken. Values beyond the range are clamped.
void searchWindowTree(const WindowTree& tree, const float* descriptor, int probes, int count,
                      TreeSearch& search);

// Inserts into `best`, which stays ascending and at most `count` long.
inline void insertFound(std::vector<Found>& best, std::size_t count, const Found& found) {
  if (best.size() < count)
    best.push_back(found);
  else if (!(found < best.back()))
    return;
  std::size_t i = best.size() - 1;
  for (; i > 0 && found < best[i - 1]; --i) best[i] = best[i - 1];
  best[i] = found;
}

// Writes the `probes` leaves of nearest means to search.leaf, best first.
void nearestLeaves(const WindowTree& tree, const float* descriptor, int probes, TreeSearch& search);

// Calls offer(Found) for all descriptors in the `probes` leaves of nearest means, best leaf first.
template <class Offer>
void visitNearest(const WindowTree& tree, const float* descriptor, int probes, TreeSearch& search,
                  const Offer& offer) {
  nearestLeaves(tree, descriptor, probes, search);
  const CodedQuery query(tree.codes, descriptor);
  for (const Found& leaf : search.leaf)
    for (std::size_t i = tree.firstBlock[leaf.index] * kCodeBlock;
         i < tree.firstBlock[leaf.index + 1] * kCodeBlock; ++i)
      if (tree.index[i] != kNoWindow) offer(Found{fineDistance(tree.codes, i, query), tree.index[i]});
}

}  // namespace fluidtex::texture
