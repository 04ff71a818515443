// A tree of descriptors by hierarchical clustering: two levels of k-means [Kwatra07 sec. V-B].
#pragma once

#include "texture/lanes.h"
#include "texture/pca.h"

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace fluidtex::texture {

// Descriptors are kept in the leaves' order and in blocks of eight, so that eight are compared at once: the
// eight values of a component side by side, one component after the other. The first components, which hold
// most of the variance and settle most comparisons, are kept apart, so that often they alone are fetched.
inline constexpr std::size_t kBlock = 8;
inline constexpr std::size_t kFirstComponents = 8;
inline constexpr std::size_t kRestComponents = kDescriptorSize - kFirstComponents;

struct DescriptorBlocks {
  std::vector<float> first;  // kBlock x kFirstComponents a block
  std::vector<float> rest;   // kBlock x kRestComponents a block
  std::size_t count() const { return first.size() / (kBlock * kFirstComponents); }
};

inline constexpr std::uint32_t kNoWindow = 0xffffffffu;

struct WindowTree {
  std::vector<std::uint32_t> firstBlock;  // #leaves + 1
  std::vector<std::uint32_t> index;       // kBlock a block: which descriptor; kNoWindow where there is none
  DescriptorBlocks descriptor;
  DescriptorBlocks leafMean;
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
};

// descriptors: #n x kDescriptorSize, n >= 1. About `leaves` leaves, fewer where n is small; none is empty,
// and each descriptor is in the leaf whose mean is nearest to it.
WindowTree buildWindowTree(std::span<const float> descriptors, int leaves, std::uint64_t seed);

// Leaves the `count` nearest descriptors of the `probes` leaves whose means are nearest in search.best,
// ascending.
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

// Squared distances of a block's descriptors; once all of them exceed `bound` they need not be complete.
inline Float8 blockDistances(const DescriptorBlocks& blocks, std::size_t block, const float* descriptor,
                             float bound) {
  Float8 even{}, odd{};
  const auto add = [&](const float* values, const float* target, std::size_t components) {
    for (std::size_t k = 0; k < components; k += 2) {
      const Float8 a = load8(values + k * kBlock) - target[k];
      const Float8 b = load8(values + (k + 1) * kBlock) - target[k + 1];
      even += a * a;
      odd += b * b;
    }
  };
  add(blocks.first.data() + block * kBlock * kFirstComponents, descriptor, kFirstComponents);
  if (atMost8(even + odd, bound) != 0)
    add(blocks.rest.data() + block * kBlock * kRestComponents, descriptor + kFirstComponents,
        kRestComponents);
  return even + odd;
}

// Calls offer(Found) for the descriptors in the `probes` leaves whose means are nearest, best leaf first,
// that are not farther than bound(), which may fall as it goes.
template <class Bound, class Offer>
void visitNearest(const WindowTree& tree, const float* descriptor, int probes, TreeSearch& search,
                  const Bound& bound, const Offer& offer) {
  nearestLeaves(tree, descriptor, probes, search);
  for (const Found& leaf : search.leaf)
    for (std::size_t b = tree.firstBlock[leaf.index]; b < tree.firstBlock[leaf.index + 1]; ++b) {
      const Float8 distance = blockDistances(tree.descriptor, b, descriptor, bound());
      for (unsigned lanes = atMost8(distance, bound()); lanes != 0; lanes &= lanes - 1) {
        const unsigned lane = unsigned(std::countr_zero(lanes));
        const std::uint32_t index = tree.index[b * kBlock + lane];
        if (index != kNoWindow) offer(Found{distance[lane], index});
      }
    }
}

}  // namespace fluidtex::texture
