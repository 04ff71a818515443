#include "texture/levelset/point_scale.h"

#include "texture/loops/parallel.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace fluidtex::texture {
namespace {

constexpr int kNodes = kBlockSide * kBlockSide * kBlockSide;

using Neighbors = std::array<std::uint32_t, 27>;  // of a block, itself in the middle

std::vector<Neighbors> neighborsOf(const LevelSet& phi) {
  std::vector<Neighbors> result(phi.blockCount());
  forEachIndex(result.size(), [&](std::uint32_t b) {
    for (int n = 0; n < 27; ++n)
      result[b][std::size_t(n)] = phi.find(phi.origin(b).offsetBy(
          (n / 9 - 1) * kBlockSide, (n / 3 % 3 - 1) * kBlockSide, (n % 3 - 1) * kBlockSide));
  });
  return result;
}

int nodeAt(int x, int y, int z) {
  return (x * kBlockSide + y) * kBlockSide + z;
}

// Local coordinates -1..8 of a block: index in Neighbors of the block that holds them.
int neighborAt(int x, int y, int z) {
  const auto part = [](int i) { return i < 0 ? 0 : i < kBlockSide ? 1 : 2; };
  return part(x) * 9 + part(y) * 3 + part(z);
}

class Limiter {
 public:
  Limiter(const LevelSet& phi, std::vector<float> nodes, float rise)
      : m_neighbors(neighborsOf(phi)), m_nodes(std::move(nodes)), m_rise(rise) {}

  // Gradient limiting: lowers what rises too steeply until nothing does. The result, the largest admissible
  // field below the given one, does not depend on the order.
  void run() {
    std::vector<std::uint32_t> active(m_neighbors.size());
    for (std::uint32_t b = 0; b < active.size(); ++b) active[b] = b;
    std::vector<std::array<float, kNodes>> lowered;
    std::vector<std::uint8_t> changed;
    while (!active.empty()) {
      lowered.resize(active.size());
      changed.assign(m_neighbors.size(), 0);
      tbb::parallel_for(std::size_t(0), active.size(),
                        [&](std::size_t i) { changed[active[i]] = lower(active[i], lowered[i]); });
      tbb::parallel_for(std::size_t(0), active.size(), [&](std::size_t i) {
        std::copy(lowered[i].begin(), lowered[i].end(), block(active[i]));
      });
      active.clear();
      for (std::uint32_t b = 0; b < m_neighbors.size(); ++b) {
        const auto isChanged = [&](std::uint32_t n) { return n != kNone && changed[n]; };
        if (std::any_of(m_neighbors[b].begin(), m_neighbors[b].end(), isChanged)) active.push_back(b);
      }
    }
  }

  // In the layout of LevelSet::setScale().
  std::vector<float> corners() const {
    constexpr int kScaled = LevelSet::kScaled;
    std::vector<float> result(m_neighbors.size() * kScaled * kScaled * kScaled);
    forEachIndex(m_neighbors.size(), [&](std::uint32_t b) {
      float* out = result.data() + std::size_t(b) * kScaled * kScaled * kScaled;
      for (int x = 0; x < kScaled; ++x)
        for (int y = 0; y < kScaled; ++y)
          for (int z = 0; z < kScaled; ++z) *out++ = value(b, x, y, z);
    });
    return result;
  }

 private:
  float* block(std::uint32_t b) { return m_nodes.data() + std::size_t(b) * kNodes; }

  // At local coordinates -1..8; without a block there, of the nearest node of this block.
  float value(std::uint32_t b, int x, int y, int z) const {
    const std::uint32_t n = m_neighbors[b][std::size_t(neighborAt(x, y, z))];
    if (n != kNone) return m_nodes[std::size_t(n) * kNodes + std::size_t(nodeAt(x & 7, y & 7, z & 7))];
    const auto inside = [](int i) { return std::clamp(i, 0, kBlockSide - 1); };
    return m_nodes[std::size_t(b) * kNodes + std::size_t(nodeAt(inside(x), inside(y), inside(z)))];
  }

  // One forward and one backward pass over a block and the nodes around it. Returns whether anything fell.
  bool lower(std::uint32_t b, std::array<float, kNodes>& result) const {
    constexpr int kWide = kBlockSide + 2;
    std::array<float, kWide * kWide * kWide> v;
    const auto at = [](int x, int y, int z) { return ((x + 1) * kWide + y + 1) * kWide + z + 1; };
    for (int x = -1; x <= kBlockSide; ++x)
      for (int y = -1; y <= kBlockSide; ++y)
        for (int z = -1; z <= kBlockSide; ++z) v[std::size_t(at(x, y, z))] = value(b, x, y, z);
    const std::array<float, 4> rise{0.0f, m_rise, m_rise * std::sqrt(2.0f), m_rise * std::sqrt(3.0f)};
    bool fell = false;
    for (const int way : {-1, 1}) {
      for (int node = 0; node < kNodes; ++node) {
        const int k = way < 0 ? node : kNodes - 1 - node;
        const int here = at(k / (kBlockSide * kBlockSide), k / kBlockSide % kBlockSide, k % kBlockSide);
        float& own = v[std::size_t(here)];
        for (int n = 0; n < 13; ++n) {  // neighbours already visited
          const int dx = n / 9 - 1, dy = n / 3 % 3 - 1, dz = n % 3 - 1;
          const int there = here - way * ((dx * kWide + dy) * kWide + dz);
          const float most = v[std::size_t(there)] + rise[std::size_t(dx * dx + dy * dy + dz * dz)];
          if (most < own) own = most, fell = true;
        }
      }
    }
    for (int node = 0; node < kNodes; ++node)
      result[std::size_t(node)] = v[std::size_t(
          at(node / (kBlockSide * kBlockSide), node / kBlockSide % kBlockSide, node % kBlockSide))];
    return fell;
  }

  std::vector<Neighbors> m_neighbors;
  std::vector<float> m_nodes;  // kNodes a block
  float m_rise;                // over one voxel
};

}  // namespace

void layScale(LevelSet& phi, const openvdb::math::Transform& transform, const PointScale& scale,
              float spacing) {
  const std::size_t count = phi.blockCount() * kNodes;
  std::vector<Vec3f> places(count);
  forEachIndex(phi.blockCount(), [&](std::uint32_t b) {
    for (int node = 0; node < kNodes; ++node) {
      const openvdb::Coord at = phi.origin(b).offsetBy(node / (kBlockSide * kBlockSide),
                                                       node / kBlockSide % kBlockSide, node % kBlockSide);
      places[std::size_t(b) * kNodes + std::size_t(node)] = Vec3f(transform.indexToWorld(at));
    }
  });
  std::vector<float> factors = scale(places);
  if (factors.size() != count)
    throw std::invalid_argument("the scale of the points must have one value a position");
  for (float& factor : factors)
    factor = std::isfinite(factor) ? std::clamp(factor, float(kLeastScale), float(kLargestScale)) : 1.0f;
  Limiter limiter(phi, std::move(factors), kScaleSlope / spacing);
  limiter.run();
  phi.setScale(limiter.corners());
}

}  // namespace fluidtex::texture
