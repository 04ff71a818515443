// A tree of descriptors by hierarchical clustering: two levels of k-means [Kwatra07 sec. V-B].
#pragma once

#include "texture/search/window_codes.h"

#include <cstdint>
#include <span>
#include <vector>

namespace fluidtex::texture {

// Means of the leaves, eight side by side, one component after the other.
inline constexpr std::size_t kMeanBlock = 8;
using MeanBlocks = std::vector<float>;  // kMeanBlock x kDescriptorSize a block

inline constexpr std::uint32_t kNoWindow = 0xffffffffu;

struct WindowTree {
  std::vector<std::uint32_t> firstBlock;  // #leaves + 1
  // kCodeBlock a block: which descriptor; kNoWindow where a leaf's last block holds none, only codes that are
  // far from the others.
  std::vector<std::uint32_t> index;
  WindowCodes codes;  // in the order of index
  MeanBlocks leafMean;
  int leaves() const { return firstBlock.empty() ? 0 : int(firstBlock.size()) - 1; }
};

struct Found {
  float distance;       // squared
  std::uint32_t index;  // of the descriptor
  // Nearer first, ties by index.
  friend bool operator<(const Found& a, const Found& b) {
    return a.distance < b.distance || (a.distance == b.distance && a.index < b.index);
  }
};

// Working memory of a search.
struct TreeSearch {
  std::vector<Found> leaf, best;
  std::vector<float> meanDistance;
  std::vector<Short16> coarse;
  std::vector<std::uint32_t> near;
};

// descriptors: #n x kDescriptorSize, n >= 1. About `leaves` leaves, fewer where n is small; none is empty,
// and each descriptor is in the leaf whose mean is nearest to it.
WindowTree buildWindowTree(std::span<const float> descriptors, int leaves, std::uint64_t seed);

// Leaves the `count` nearest descriptors of the `probes` leaves whose means are nearest in search.best,
// ascending; by their codes, that is: of two that are as near but for a hundredth of the range of all, the
// farther one may be taken. What is beyond that range counts as at its end.
void searchWindowTree(const WindowTree& tree, const float* descriptor, int probes, int count,
                      TreeSearch& search);

// Keeps `best` ascending and at most `count` long.
inline void insertFound(std::vector<Found>& best, std::size_t count, const Found& found) {
  if (best.size() < count)
    best.push_back(found);
  else if (!(found < best.back()))
    return;
  std::size_t i = best.size() - 1;
  for (; i > 0 && found < best[i - 1]; --i) best[i] = best[i - 1];
  best[i] = found;
}

// Fills search.leaf with the `probes` leaves whose means are nearest, best first.
void nearestLeaves(const WindowTree& tree, const float* descriptor, int probes, TreeSearch& search);

// Calls offer(Found) for all descriptors in the `probes` leaves whose means are nearest, best leaf first.
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
