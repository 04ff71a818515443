// Clustering by Lloyd's k-means from starts chosen as in D. Arthur, S. Vassilvitskii, "k-means++: the
// advantages of careful seeding", 2007. Means are learnt from a sample, then all descriptors are sorted into
// them.

#include "texture/window_tree.h"

#include "texture/random.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace fluidtex::texture {
namespace {

constexpr std::size_t kSamples = 4096;  // means are learnt from at most as many
constexpr int kSweeps = 8;
constexpr float kFar = 1e15f;  // fills lanes that hold nothing; its square is still finite
constexpr std::size_t kBlockSize = std::size_t(kBlock) * kDescriptorSize;
constexpr float kNoBound = std::numeric_limits<float>::infinity();

using Indices = std::vector<std::uint32_t>;

// Means in blocks, as WindowTree keeps them.
struct Means {
  std::vector<float> block;
  int count = 0;

  explicit Means(int n) : block(std::size_t((n + kBlock - 1) / kBlock) * kBlockSize, kFar), count(n) {}
  void set(int i, const double* value) {
    for (int k = 0; k < kDescriptorSize; ++k)
      block[std::size_t(i / kBlock) * kBlockSize + std::size_t(k * kBlock + i % kBlock)] = float(value[k]);
  }
  Found nearest(const float* descriptor) const {
    Found best{kNoBound, 0};
    for (std::size_t b = 0; b * kBlockSize < block.size(); ++b) {
      const Float8 distance = blockDistances(block.data() + b * kBlockSize, descriptor, best.distance);
      for (std::uint32_t lane = 0; lane < kBlock; ++lane)
        if (distance[lane] < best.distance) best = {distance[lane], std::uint32_t(b * kBlock) + lane};
    }
    return best;
  }
};

void setFrom(Means& means, int i, const float* descriptor) {
  double value[kDescriptorSize];
  std::copy_n(descriptor, kDescriptorSize, value);
  means.set(i, value);
}

// `count` starts: the first at random, each further one with a probability that grows with its squared
// distance from those before.
Means starts(std::span<const float> descriptors, const Indices& sample, int count, std::uint64_t seed) {
  Means means(count);
  std::vector<float> distance(sample.size(), kNoBound);
  std::size_t chosen = randomBelow(seed, 0, sample.size());
  for (int m = 0; m < count; ++m) {
    const float* mean = descriptors.data() + std::size_t(sample[chosen]) * kDescriptorSize;
    setFrom(means, m, mean);
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

Means kMeans(std::span<const float> descriptors, const Indices& members, int count, std::uint64_t seed) {
  Indices sample;
  const std::size_t size = std::min(kSamples, members.size());
  for (std::size_t s = 0; s < size; ++s) sample.push_back(members[s * members.size() / size]);
  Means means = starts(descriptors, sample, count, seed);
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    std::vector<double> sum(std::size_t(count) * kDescriptorSize, 0.0);
    std::vector<int> share(std::size_t(count), 0);
    for (const std::uint32_t s : sample) {
      const float* value = descriptors.data() + std::size_t(s) * kDescriptorSize;
      const std::uint32_t mean = means.nearest(value).index;
      for (std::size_t k = 0; k < kDescriptorSize; ++k) sum[mean * kDescriptorSize + k] += value[k];
      ++share[mean];
    }
    for (int m = 0; m < count; ++m) {
      if (share[std::size_t(m)] == 0) continue;  // stays where it is
      double* total = sum.data() + std::size_t(m) * kDescriptorSize;
      for (int k = 0; k < kDescriptorSize; ++k) total[k] /= share[std::size_t(m)];
      means.set(m, total);
    }
  }
  return means;
}

// The members of each of `count` clusters, in the order of `members`.
std::vector<Indices> clusters(std::span<const float> descriptors, const Indices& members, int count,
                              std::uint64_t seed) {
  std::vector<Indices> result(std::size_t(std::max(count, 1)));
  if (count <= 1) {
    result[0] = members;
    return result;
  }
  const Means means = kMeans(descriptors, members, count, seed);
  Indices cluster(members.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, members.size(), 1024), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i)
      cluster[i] = means.nearest(descriptors.data() + std::size_t(members[i]) * kDescriptorSize).index;
  });
  for (std::size_t i = 0; i < members.size(); ++i) result[cluster[i]].push_back(members[i]);
  return result;
}

void appendLeaf(WindowTree& tree, std::span<const float> descriptors, const Indices& members) {
  for (std::size_t first = 0; first < members.size(); first += kBlock) {
    tree.descriptor.resize(tree.descriptor.size() + kBlockSize, kFar);
    float* block = tree.descriptor.data() + tree.descriptor.size() - kBlockSize;
    for (std::size_t lane = 0; lane < kBlock; ++lane) {
      const bool exists = first + lane < members.size();
      tree.index.push_back(exists ? members[first + lane] : kNoWindow);
      if (!exists) continue;
      const float* value = descriptors.data() + std::size_t(members[first + lane]) * kDescriptorSize;
      for (std::size_t k = 0; k < kDescriptorSize; ++k) block[k * kBlock + lane] = value[k];
    }
  }
  tree.firstBlock.push_back(std::uint32_t(tree.index.size() / kBlock));
}

}  // namespace

WindowTree buildWindowTree(std::span<const float> descriptors, int leaves, std::uint64_t seed) {
  Indices all(descriptors.size() / kDescriptorSize);
  std::iota(all.begin(), all.end(), 0u);
  const std::vector<Indices> branches =
      clusters(descriptors, all, int(std::lround(std::sqrt(double(leaves)))), seed);
  std::vector<std::vector<Indices>> leavesOf(branches.size());
  tbb::parallel_for(std::size_t(0), branches.size(), [&](std::size_t b) {
    if (branches[b].empty()) return;
    // Leaves of like size: a branch is cut into as many as its share.
    const double share = double(leaves) * double(branches[b].size()) / double(all.size());
    leavesOf[b] =
        clusters(descriptors, branches[b], std::max(1, int(std::lround(share))), randomBits(seed, b + 1));
  });

  WindowTree tree;
  tree.firstBlock.push_back(0);
  std::vector<std::array<double, kDescriptorSize>> mean;
  for (const auto& branch : leavesOf)
    for (const Indices& members : branch) {
      if (members.empty()) continue;
      appendLeaf(tree, descriptors, members);
      auto& sum = mean.emplace_back();
      for (const std::uint32_t i : members)
        for (std::size_t k = 0; k < kDescriptorSize; ++k)
          sum[k] += descriptors[i * std::size_t(kDescriptorSize) + k];
      for (double& value : sum) value /= double(members.size());
    }
  Means means(int(mean.size()));
  for (int m = 0; m < means.count; ++m) means.set(m, mean[std::size_t(m)].data());
  tree.leafMean = std::move(means.block);
  return tree;
}

Float8 blockDistances(const float* block, const float* descriptor, float bound) {
  // The first components hold most of the variance, so most blocks are done after a third.
  constexpr int kFirst = 8;
  Float8 even{}, odd{};
  const auto add = [&](int from, int to) {
    for (int k = from; k < to; k += 2) {
      const Float8 a = load8(block + k * kBlock) - descriptor[k],
                   b = load8(block + (k + 1) * kBlock) - descriptor[k + 1];
      even += a * a;
      odd += b * b;
    }
  };
  add(0, kFirst);
  if (atMost8(even + odd, bound) == 0) return even + odd;
  add(kFirst, kDescriptorSize);
  return even + odd;
}

void nearestLeaves(const WindowTree& tree, const float* descriptor, int probes, TreeSearch& search) {
  std::vector<Found>& best = search.leaf;
  best.clear();
  const std::size_t count = std::size_t(std::clamp(probes, 0, tree.leaves()));
  if (count == 0) return;
  float bound = kNoBound;
  for (std::size_t b = 0; b * kBlockSize < tree.leafMean.size(); ++b) {
    const Float8 distance = blockDistances(tree.leafMean.data() + b * kBlockSize, descriptor, bound);
    for (unsigned lanes = atMost8(distance, bound); lanes != 0; lanes &= lanes - 1) {
      const unsigned lane = unsigned(std::countr_zero(lanes));
      const Found leaf{distance[lane], std::uint32_t(b * kBlock) + lane};
      if (int(leaf.index) < tree.leaves()) insertFound(best, count, leaf);
    }
    if (best.size() == count) bound = best.back().distance;
  }
}

void insertFound(std::vector<Found>& best, std::size_t count, const Found& found) {
  if (best.size() == count) {
    if (!(found < best.back())) return;
    best.pop_back();
  }
  best.insert(std::upper_bound(best.begin(), best.end(), found), found);
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
