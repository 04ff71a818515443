// Lloyd's k-means with the seeding of D. Arthur, S. Vassilvitskii, "k-means++: the advantages of careful
// seeding", 2007. Means are found on a sample, then all descriptors are assigned to them.

#include "texture/search/window_tree.h"

#include "numerics/random.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

namespace fluidtex::texture {
namespace {

constexpr std::size_t kMeansSampled = 4096;  // largest sample
constexpr int kSweeps = 8;
constexpr float kFar = 1e15f;  // fills unused lanes; its square is still finite
constexpr float kNoBound = std::numeric_limits<float>::infinity();

using Indices = std::vector<std::uint32_t>;

template <class Scalar>
void setLane(MeanBlocks& blocks, std::size_t i, const Scalar* value) {
  const std::size_t block = i / kMeanBlock, lane = i % kMeanBlock;
  for (std::size_t k = 0; k < kDescriptorSize; ++k)
    blocks[(block * kDescriptorSize + k) * kMeanBlock + lane] = float(value[k]);
}

MeanBlocks emptyBlocks(std::size_t count) {
  return MeanBlocks((count + kMeanBlock - 1) / kMeanBlock * kMeanBlock * kDescriptorSize, kFar);
}

std::size_t blocksOf(const MeanBlocks& means) {
  return means.size() / (kMeanBlock * kDescriptorSize);
}

// Squared distances to the means of a block.
Float8 blockDistances(const MeanBlocks& means, std::size_t block, const float* descriptor) {
  const float* values = means.data() + block * kMeanBlock * kDescriptorSize;
  Float8 even{}, odd{};
  for (std::size_t k = 0; k < kDescriptorSize; k += 2) {
    const Float8 a = load8(values + k * kMeanBlock) - descriptor[k];
    const Float8 b = load8(values + (k + 1) * kMeanBlock) - descriptor[k + 1];
    even += a * a;
    odd += b * b;
  }
  return even + odd;
}

std::uint32_t nearestOf(const MeanBlocks& means, const float* descriptor) {
  Found best{kNoBound, 0};
  for (std::size_t b = 0; b < blocksOf(means); ++b) {
    const Float8 distance = blockDistances(means, b, descriptor);
    if (below8(distance, best.distance) == 0) continue;
    for (std::size_t lane = 0; lane < kMeanBlock; ++lane)
      if (distance[lane] < best.distance) best = {distance[lane], std::uint32_t(b * kMeanBlock + lane)};
  }
  return best.index;
}

// k-means++: the first start at random, each further one with a probability that grows with its squared
// distance from the earlier ones.
MeanBlocks starts(std::span<const float> descriptors, const Indices& sample, int count, std::uint64_t seed) {
  MeanBlocks means = emptyBlocks(std::size_t(count));
  std::vector<float> distance(sample.size(), kNoBound);
  std::size_t chosen = randomBelow(seed, 0, sample.size());
  for (int m = 0; m < count; ++m) {
    const float* mean = descriptors.data() + std::size_t(sample[chosen]) * kDescriptorSize;
    setLane(means, std::size_t(m), mean);
    double sum = 0.0;
    for (std::size_t s = 0; s < sample.size(); ++s) {
      const float* value = descriptors.data() + std::size_t(sample[s]) * kDescriptorSize;
      Float8 squares{};
      for (int k = 0; k < kDescriptorSize; k += 8) {
        const Float8 difference = load8(value + k) - load8(mean + k);
        squares += difference * difference;
      }
      distance[s] = std::min(distance[s], sum8(squares));
      sum += distance[s];
    }
    double rest = randomUnit(seed, std::uint64_t(m) + 1) * sum;
    chosen = 0;
    while (chosen + 1 < sample.size() && (rest -= distance[chosen]) > 0.0) ++chosen;
  }
  return means;
}

MeanBlocks kMeans(std::span<const float> descriptors, const Indices& members, int count, std::uint64_t seed) {
  Indices sample;
  const std::size_t size = std::min(kMeansSampled, members.size());
  for (std::size_t s = 0; s < size; ++s) sample.push_back(members[s * members.size() / size]);
  MeanBlocks means = starts(descriptors, sample, count, seed);
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    std::vector<double> sum(std::size_t(count) * kDescriptorSize, 0.0);
    std::vector<int> share(std::size_t(count), 0);
    for (const std::uint32_t s : sample) {
      const float* value = descriptors.data() + std::size_t(s) * kDescriptorSize;
      const std::uint32_t mean = nearestOf(means, value);
      for (std::size_t k = 0; k < kDescriptorSize; ++k) sum[mean * kDescriptorSize + k] += value[k];
      ++share[mean];
    }
    for (int m = 0; m < count; ++m) {
      if (share[std::size_t(m)] == 0) continue;  // an empty cluster keeps its mean
      double* total = sum.data() + std::size_t(m) * kDescriptorSize;
      for (int k = 0; k < kDescriptorSize; ++k) total[k] /= share[std::size_t(m)];
      setLane(means, std::size_t(m), total);
    }
  }
  return means;
}

// Nearest mean of each of `members`.
Indices nearestMeans(const MeanBlocks& means, std::span<const float> descriptors, const Indices& members) {
  Indices result(members.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, members.size(), 1024), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i)
      result[i] = nearestOf(means, descriptors.data() + std::size_t(members[i]) * kDescriptorSize);
  });
  return result;
}

// Members of each of `count` clusters, in the order of `members`.
std::vector<Indices> clusters(std::span<const float> descriptors, const Indices& members, int count,
                              std::uint64_t seed) {
  std::vector<Indices> result(std::size_t(std::max(count, 1)));
  if (count <= 1 || members.empty()) {
    result[0] = members;
    return result;
  }
  const Indices nearest = nearestMeans(kMeans(descriptors, members, count, seed), descriptors, members);
  for (std::size_t i = 0; i < members.size(); ++i) result[nearest[i]].push_back(members[i]);
  return result;
}

std::vector<double> meanOf(std::span<const float> descriptors, const Indices& members) {
  std::vector<double> mean(kDescriptorSize, 0.0);
  for (const std::uint32_t i : members)
    for (std::size_t k = 0; k < kDescriptorSize; ++k)
      mean[k] += descriptors[i * std::size_t(kDescriptorSize) + k];
  for (double& value : mean) value /= double(members.size());
  return mean;
}

void appendLeaf(WindowTree& tree, std::span<const float> descriptors, const Indices& members) {
  for (const std::uint32_t i : members) {
    tree.index.push_back(i);
    addCode(tree.codes, descriptors.data() + i * std::size_t(kDescriptorSize));
  }
  // Padding gets the corner of the range farthest from one of the members.
  const std::vector<std::int16_t>& fine = tree.codes.fine;
  std::array<std::int16_t, kDescriptorSize> far;
  for (std::size_t k = 0; k < kDescriptorSize; ++k)
    far[k] = fine[fine.size() - kDescriptorSize + k] < 16384 ? 32767 : 0;
  while (tree.index.size() % kCodeBlock != 0) {
    tree.index.push_back(kNoWindow);
    tree.codes.fine.insert(tree.codes.fine.end(), far.begin(), far.end());
  }
  tree.firstBlock.push_back(std::uint32_t(tree.index.size() / kCodeBlock));
}

// A coarse distance that at least `count` windows do not exceed, and few more: found by counting the nearest
// of each group of windows.
std::int16_t coarseBound(const std::vector<Short16>& distance, std::size_t count) {
  constexpr std::size_t kGroups = 16;  // per lane
  constexpr int kLargestCode = 32767;
  const std::size_t each = std::max<std::size_t>(1, (distance.size() + kGroups - 1) / kGroups);
  std::array<Short16, kGroups> nearest;
  std::size_t groups = 0;
  for (std::size_t begin = 0; begin < distance.size(); begin += each) {
    Short16 least = distance[begin];
    for (std::size_t i = begin + 1; i < std::min(begin + each, distance.size()); ++i)
      least = distance[i] < least ? distance[i] : least;
    nearest[groups++] = least;
  }
  if (groups * kCodeBlock < count) return kLargestCode;
  int below = -1, enough = kLargestCode;
  while (enough - below > 1) {
    const int middle = (below + enough) / 2;
    Short16 tally{};
    for (std::size_t g = 0; g < groups; ++g) tally -= nearest[g] <= std::int16_t(middle);
    std::size_t sum = 0;
    for (std::size_t lane = 0; lane < kCodeBlock; ++lane) sum += std::size_t(tally[lane]);
    (sum >= count ? enough : below) = middle;
  }
  return std::int16_t(enough);
}

}  // namespace

WindowTree buildWindowTree(std::span<const float> descriptors, int leaves, std::uint64_t seed) {
  Indices all(descriptors.size() / kDescriptorSize);
  std::iota(all.begin(), all.end(), 0u);
  const std::vector<Indices> branches =
      clusters(descriptors, all, int(std::lround(std::sqrt(double(leaves)))), seed);
  std::vector<std::vector<Indices>> leavesOf(branches.size());
  tbb::parallel_for(std::size_t(0), branches.size(), [&](std::size_t b) {
    // Leaves of similar size: a branch is split in proportion to its members.
    const double share = double(leaves) * double(branches[b].size()) / double(all.size());
    leavesOf[b] =
        clusters(descriptors, branches[b], std::max(1, int(std::lround(share))), randomBits(seed, b + 1));
  });
  std::vector<std::vector<double>> mean;
  for (const auto& branch : leavesOf)
    for (const Indices& members : branch)
      if (!members.empty()) mean.push_back(meanOf(descriptors, members));
  MeanBlocks means = emptyBlocks(mean.size());
  for (std::size_t m = 0; m < mean.size(); ++m) setLane(means, m, mean[m].data());

  // The nearest mean may belong to another branch. With every descriptor in the leaf of its nearest mean, a
  // query that equals one finds it with the first probe.
  std::vector<Indices> members(mean.size());
  const Indices nearest = nearestMeans(means, descriptors, all);
  for (std::size_t i = 0; i < all.size(); ++i) members[nearest[i]].push_back(std::uint32_t(i));

  WindowTree tree;
  tree.codes = codesFor(descriptors);
  tree.firstBlock.push_back(0);
  tree.leafMean = emptyBlocks(members.size());
  for (std::size_t m = 0; m < members.size(); ++m) {
    if (members[m].empty()) continue;
    setLane(tree.leafMean, tree.firstBlock.size() - 1, mean[m].data());
    appendLeaf(tree, descriptors, members[m]);
  }
  makeCoarse(tree.codes);
  return tree;
}

void nearestLeaves(const WindowTree& tree, const float* descriptor, int probes, TreeSearch& search) {
  std::vector<float>& distance = search.meanDistance;
  distance.resize(blocksOf(tree.leafMean) * kMeanBlock);
  for (std::size_t b = 0; b < blocksOf(tree.leafMean); ++b)
    store8(distance.data() + b * kMeanBlock, blockDistances(tree.leafMean, b, descriptor));
  search.leaf.clear();
  for (int probe = 0; probe < std::min(probes, tree.leaves()); ++probe) {
    Float8 least = Float8{} + kNoBound;
    for (std::size_t i = 0; i < distance.size(); i += kMeanBlock) {
      const Float8 these = load8(distance.data() + i);
      least = these < least ? these : least;
    }
    Found best{least[0], std::uint32_t(probe)};  // kept where distances are NaN
    for (std::size_t lane = 1; lane < kMeanBlock; ++lane)
      best.distance = std::min(best.distance, least[lane]);
    for (std::size_t i = 0; i < distance.size(); i += kMeanBlock)
      if (const unsigned lanes = atMost8(load8(distance.data() + i), best.distance); lanes != 0) {
        best.index = std::uint32_t(i) + std::uint32_t(std::countr_zero(lanes));
        break;
      }
    distance[best.index] = kNoBound;
    search.leaf.push_back(best);
  }
}

void searchWindowTree(const WindowTree& tree, const float* descriptor, int probes, int count,
                      TreeSearch& search) {
  constexpr std::size_t kSpare = 4;  // extra candidates for the fine distance
  search.best.clear();
  if (count < 1) return;
  nearestLeaves(tree, descriptor, probes, search);
  const CodedQuery query(tree.codes, descriptor);
  search.coarse.clear();
  for (const Found& leaf : search.leaf)
    for (std::size_t b = tree.firstBlock[leaf.index]; b < tree.firstBlock[leaf.index + 1]; ++b)
      search.coarse.push_back(coarseDistances(tree.codes, b, query));
  const std::int16_t bound = coarseBound(search.coarse, std::size_t(count) + kSpare);

  // Prefetched, since they are scattered in memory.
  search.near.clear();
  std::size_t at = 0;
  for (const Found& leaf : search.leaf)
    for (std::size_t b = tree.firstBlock[leaf.index]; b < tree.firstBlock[leaf.index + 1]; ++b)
      for (unsigned lanes = atMost16(search.coarse[at++], bound); lanes != 0; lanes &= lanes - 1) {
        const auto i = std::uint32_t(b * kCodeBlock) + std::uint32_t(std::countr_zero(lanes));
        __builtin_prefetch(tree.codes.fine.data() + i * std::size_t(kDescriptorSize));
        search.near.push_back(i);
      }
  for (const std::uint32_t i : search.near)
    if (tree.index[i] != kNoWindow)
      insertFound(search.best, std::size_t(count), {fineDistance(tree.codes, i, query), tree.index[i]});
}

}  // namespace fluidtex::texture
