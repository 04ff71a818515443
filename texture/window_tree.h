// A tree of descriptors by hierarchical clustering: two levels of k-means [Kwatra07 sec. V-B].
#pragma once

#include "texture/pca.h"

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
};

// Working memory of a search.
struct TreeSearch {
  std::vector<Found> leaf, best;
};

// descriptors: #n x kDescriptorSize, n >= 1. About `leaves` leaves, fewer where n is small; none is empty.
WindowTree buildWindowTree(std::span<const float> descriptors, int leaves, std::uint64_t seed);

// Visits the leaves whose means are nearest, best first, `probes` of them, and leaves the `count` nearest
// descriptors in search.best, ascending; ties go to the smaller index.
void searchWindowTree(const WindowTree& tree, std::span<const float> descriptor, int probes, int count,
                      TreeSearch& search);

}  // namespace fluidtex::texture
