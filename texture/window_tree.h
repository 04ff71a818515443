// A tree of descriptors by hierarchical clustering: two levels of k-means [Kwatra07 sec. V-B].
#pragma once

#include "texture/lanes.h"
#include "texture/pca.h"

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace fluidtex::texture {

// Descriptors are kept in the leaves' order and in blocks of eight, dimension by dimension, so that eight are
// compared at once.
inline constexpr int kBlock = 8;

struct WindowTree {
  std::vector<std::uint32_t> firstBlock;  // #leaves + 1
  std::vector<std::uint32_t> index;  // kBlock a block: which descriptor; kNoWindow where a block is not full
  std::vector<float>
      descriptor;  // kBlock x kDescriptorSize a block, the eight values of a dimension side by side
  std::vector<float> leafMean;  // the leaves' means, in blocks likewise
  int leaves() const { return firstBlock.empty() ? 0 : int(firstBlock.size()) - 1; }
};

inline constexpr std::uint32_t kNoWindow = 0xffffffffu;

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
};

// descriptors: #n x kDescriptorSize, n >= 1. About `leaves` leaves, fewer where n is small; none is empty.
WindowTree buildWindowTree(std::span<const float> descriptors, int leaves, std::uint64_t seed);

// Keeps `best` ascending and at most `count` long.
void insertFound(std::vector<Found>& best, std::size_t count, const Found& found);

// Eight squared distances at once; once all of them exceed `bound` they need not be complete.
Float8 blockDistances(const float* block, const float* descriptor, float bound);

// Fills search.leaf with the `probes` leaves whose means are nearest, best first.
void nearestLeaves(const WindowTree& tree, const float* descriptor, int probes, TreeSearch& search);

// Calls offer(Found) for the descriptors in the `probes` leaves whose means are nearest, best leaf first,
// that are not farther than bound(), which may fall as it goes.
template <class Bound, class Offer>
void visitNearest(const WindowTree& tree, const float* descriptor, int probes, TreeSearch& search,
                  const Bound& bound, const Offer& offer) {
  nearestLeaves(tree, descriptor, probes, search);
  for (const Found& leaf : search.leaf)
    for (std::uint32_t block = tree.firstBlock[leaf.index]; block < tree.firstBlock[leaf.index + 1];
         ++block) {
      const Float8 distance = blockDistances(
          tree.descriptor.data() + std::size_t(block) * kBlock * kDescriptorSize, descriptor, bound());
      for (unsigned lanes = atMost8(distance, bound()); lanes != 0; lanes &= lanes - 1) {
        const unsigned lane = unsigned(std::countr_zero(lanes));
        const std::uint32_t index = tree.index[std::size_t(block) * kBlock + lane];
        if (index != kNoWindow) offer(Found{distance[lane], index});
      }
    }
}

// The `count` nearest of those, in search.best, ascending.
void searchWindowTree(const WindowTree& tree, const float* descriptor, int probes, int count,
                      TreeSearch& search);

}  // namespace fluidtex::texture
