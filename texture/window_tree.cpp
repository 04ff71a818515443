// Clustering by Lloyd's k-means from starts chosen as in D. Arthur, S. Vassilvitskii, "k-means++: the
// advantages of careful seeding", 2007. Means are learnt from a sample, then all descriptors are sorted into
// them.

#include "texture/window_tree.h"

#include "texture/random.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace fluidtex::texture {
namespace {

constexpr std::size_t kSamples = 4096;  // means are learnt from at most as many
constexpr int kSweeps = 8;
constexpr float kFar = 1e15f;  // fills lanes that hold nothing; its square is still finite
constexpr float kNoBound = std::numeric_limits<float>::infinity();

using Indices = std::vector<std::uint32_t>;

// Adds a block that holds nothing.
void addBlock(DescriptorBlocks& blocks) {
  blocks.first.resize(blocks.first.size() + kBlock * kFirstComponents, kFar);
  blocks.rest.resize(blocks.rest.size() + kBlock * kRestComponents, kFar);
}

template <class Scalar>
void setLane(DescriptorBlocks& blocks, std::size_t i, const Scalar* value) {
  const std::size_t block = i / kBlock, lane = i % kBlock;
  for (std::size_t k = 0; k < kFirstComponents; ++k)
    blocks.first[(block * kFirstComponents + k) * kBlock + lane] = float(value[k]);
  for (std::size_t k = 0; k < kRestComponents; ++k)
    blocks.rest[(block * kRestComponents + k) * kBlock + lane] = float(value[kFirstComponents + k]);
}

DescriptorBlocks emptyBlocks(std::size_t count) {
  DescriptorBlocks blocks;
  for (std::size_t i = 0; i < count; i += kBlock) addBlock(blocks);
  return blocks;
}

std::uint32_t nearestOf(const DescriptorBlocks& means, const float* descriptor) {
  Found best{kNoBound, 0};
  for (std::size_t b = 0; b < means.count(); ++b) {
    const Float8 distance = blockDistances(means, b, descriptor, best.distance);
    for (std::size_t lane = 0; lane < kBlock; ++lane)
      if (distance[lane] < best.distance) best = {distance[lane], std::uint32_t(b * kBlock + lane)};
  }
  return best.index;
}

// `count` starts: the first at random, each further one with a probability that grows with its squared
// distance from those before.
DescriptorBlocks starts(std::span<const float> descriptors, const Indices& sample, int count,
                        std::uint64_t seed) {
  DescriptorBlocks means = emptyBlocks(std::size_t(count));
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

DescriptorBlocks kMeans(std::span<const float> descriptors, const Indices& members, int count,
                        std::uint64_t seed) {
  Indices sample;
  const std::size_t size = std::min(kSamples, members.size());
  for (std::size_t s = 0; s < size; ++s) sample.push_back(members[s * members.size() / size]);
  DescriptorBlocks means = starts(descriptors, sample, count, seed);
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
      if (share[std::size_t(m)] == 0) continue;  // stays where it is
      double* total = sum.data() + std::size_t(m) * kDescriptorSize;
      for (int k = 0; k < kDescriptorSize; ++k) total[k] /= share[std::size_t(m)];
      setLane(means, std::size_t(m), total);
    }
  }
  return means;
}

// For each of `members`, which mean is nearest.
Indices nearestMeans(const DescriptorBlocks& means, std::span<const float> descriptors,
                     const Indices& members) {
  Indices result(members.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, members.size(), 1024), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i)
      result[i] = nearestOf(means, descriptors.data() + std::size_t(members[i]) * kDescriptorSize);
  });
  return result;
}

// The members of each of `count` clusters, in the order of `members`.
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
  const std::size_t first = tree.index.size();
  for (std::size_t i = 0; i < members.size(); ++i) {
    if (i % kBlock == 0) {
      addBlock(tree.descriptor);
      tree.index.resize(tree.index.size() + kBlock, kNoWindow);
    }
    tree.index[first + i] = members[i];
    setLane(tree.descriptor, first + i, descriptors.data() + std::size_t(members[i]) * kDescriptorSize);
  }
  tree.firstBlock.push_back(std::uint32_t(tree.descriptor.count()));
}

}  // namespace

WindowTree buildWindowTree(std::span<const float> descriptors, int leaves, std::uint64_t seed) {
  Indices all(descriptors.size() / kDescriptorSize);
  std::iota(all.begin(), all.end(), 0u);
  const std::vector<Indices> branches =
      clusters(descriptors, all, int(std::lround(std::sqrt(double(leaves)))), seed);
  std::vector<std::vector<Indices>> leavesOf(branches.size());
  tbb::parallel_for(std::size_t(0), branches.size(), [&](std::size_t b) {
    // Leaves of like size: a branch is cut into as many as its share.
    const double share = double(leaves) * double(branches[b].size()) / double(all.size());
    leavesOf[b] =
        clusters(descriptors, branches[b], std::max(1, int(std::lround(share))), randomBits(seed, b + 1));
  });
  std::vector<std::vector<double>> mean;
  for (const auto& branch : leavesOf)
    for (const Indices& members : branch)
      if (!members.empty()) mean.push_back(meanOf(descriptors, members));
  DescriptorBlocks means = emptyBlocks(mean.size());
  for (std::size_t m = 0; m < mean.size(); ++m) setLane(means, m, mean[m].data());

  // Across the branches' borders another leaf's mean may be nearer. With every descriptor in the leaf of the
  // nearest mean, a query that equals one is found by the first probe.
  std::vector<Indices> members(mean.size());
  const Indices nearest = nearestMeans(means, descriptors, all);
  for (std::size_t i = 0; i < all.size(); ++i) members[nearest[i]].push_back(std::uint32_t(i));

  WindowTree tree;
  tree.firstBlock.push_back(0);
  for (std::size_t m = 0; m < members.size(); ++m) {
    if (members[m].empty()) continue;
    const std::size_t leaf = tree.firstBlock.size() - 1;
    if (leaf % kBlock == 0) addBlock(tree.leafMean);
    setLane(tree.leafMean, leaf, mean[m].data());
    appendLeaf(tree, descriptors, members[m]);
  }
  return tree;
}

void nearestLeaves(const WindowTree& tree, const float* descriptor, int probes, TreeSearch& search) {
  std::vector<Found>& best = search.leaf;
  best.clear();
  const std::size_t count = std::size_t(std::clamp(probes, 0, tree.leaves()));
  if (count == 0) return;
  float bound = kNoBound;
  for (std::size_t b = 0; b < tree.leafMean.count(); ++b) {
    const Float8 distance = blockDistances(tree.leafMean, b, descriptor, bound);
    for (unsigned lanes = atMost8(distance, bound); lanes != 0; lanes &= lanes - 1) {
      const unsigned lane = unsigned(std::countr_zero(lanes));
      const Found leaf{distance[lane], std::uint32_t(b * kBlock) + lane};
      if (int(leaf.index) < tree.leaves()) insertFound(best, count, leaf);
    }
    if (best.size() == count) bound = best.back().distance;
  }
}

void searchWindowTree(const WindowTree& tree, const float* descriptor, int probes, int count,
                      TreeSearch& search) {
  std::vector<Found>& best = search.best;
  best.clear();
  if (count < 1) return;
  visitNearest(
      tree, descriptor, probes, search,
      [&] { return best.size() == std::size_t(count) ? best.back().distance : kNoBound; },
      [&](const Found& found) { insertFound(best, std::size_t(count), found); });
}

}  // namespace fluidtex::texture
