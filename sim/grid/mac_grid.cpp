// The staggered grid: Harlow and Welch, "Numerical calculation of time-dependent viscous incompressible flow
// of fluid with free surface", 1965. Storage: Museth, "VDB: high-resolution sparse volumes with dynamic
// topology", 2013.
#include "sim/grid/mac_grid.h"

#include "sim/grid/require.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <utility>

namespace fluidtex::sim {

openvdb::math::Transform::Ptr cellTransform(double h) {
  auto transform = openvdb::math::Transform::createLinearTransform(h);
  transform->postTranslate(Vec3d(0.5 * h));
  return transform;
}

openvdb::math::Transform::Ptr faceTransform(double h, int axis) {
  Vec3d shift(0.5 * h);
  shift[axis] = 0.0;
  auto transform = openvdb::math::Transform::createLinearTransform(h);
  transform->postTranslate(shift);
  return transform;
}

Coord cellCount(const Vec3d& size, double h) {
  // A side that is a whole number of cells except for rounding gets no further cell.
  constexpr double kSlack = 1e-6;
  Coord n;
  for (int a = 0; a < 3; ++a) n[a] = std::max(1, static_cast<int>(std::ceil(size[a] / h - kSlack)));
  return n;
}

CoordBBox firstCells(const Coord& count) {
  return {Coord(0), count.offsetBy(-1)};
}

CoordBBox cellsIn(const openvdb::BBoxd& box, double h) {
  const auto cell = [&](double x) {
    return static_cast<int>(std::clamp(std::floor(x / h), double(-kEndless), kEndless - 1.0));
  };
  if (box.empty()) return {};
  const Vec3d &low = box.min(), &high = box.max();
  return {Coord(cell(low[0]), cell(low[1]), cell(low[2])),
          Coord(cell(high[0]), cell(high[1]), cell(high[2]))};
}

bool isEndless(const CoordBBox& box) {
  for (int a = 0; a < 3; ++a) {
    if (box.min()[a] <= -kEndless || box.max()[a] >= kEndless - 1) return true;
  }
  return false;
}

CoordBBox grown(CoordBBox box, int layers) {
  box.expand(layers);
  return box;
}

FloatGrid::Ptr makePhi(double h, double background) {
  auto phi = FloatGrid::create(static_cast<float>(background));
  phi->setTransform(cellTransform(h));
  phi->setGridClass(openvdb::GRID_LEVEL_SET);
  phi->setName("phi");
  return phi;
}

Velocity makeVelocity(double h) {
  static constexpr const char* kNames[3] = {"u", "v", "w"};
  Velocity velocity;
  for (int a = 0; a < 3; ++a) {
    velocity.component[a] = FloatGrid::create(0.0f);
    velocity.component[a]->setTransform(faceTransform(h, a));
    velocity.component[a]->setName(kNames[a]);
  }
  return velocity;
}

Velocity makeVelocity(double h, const FloatTree& like) {
  Velocity velocity = makeVelocity(h);
  for (auto& grid : velocity.component) {
    grid->setTree(std::make_shared<FloatTree>(like, 0.0f, openvdb::TopologyCopy()));
  }
  return velocity;
}

Velocity copyOf(const Velocity& velocity) {
  Velocity copy;
  for (int a = 0; a < 3; ++a) {
    copy.component[a] = velocity.component[a]->deepCopy();
    // OpenVDB makes the copy's transform anew, which can change its last bits.
    copy.component[a]->setTransform(velocity.component[a]->transformPtr());
  }
  return copy;
}

void uniteTopology(Velocity& velocity) {
  const auto& [u, v, w] = velocity.component;
  u->topologyUnion(*v);
  u->topologyUnion(*w);
  v->topologyUnion(*u);
  w->topologyUnion(*u);
}

std::vector<FloatLeaf*> leavesOf(FloatTree& tree) {
  std::vector<FloatLeaf*> leaves;
  leaves.reserve(tree.leafCount());
  tree.getNodes(leaves);
  return leaves;
}

std::vector<const FloatLeaf*> leavesOf(const FloatTree& tree) {
  std::vector<const FloatLeaf*> leaves;
  leaves.reserve(tree.leafCount());
  tree.getNodes(leaves);
  return leaves;
}

namespace {

// Halo and width are known at compile time, so that each row is a few moves.
template <int kHalo>
void copyBox(const float* const* block, float* out, bool crossOnly) {
  constexpr int kSide = kLeafDim + 2 * kHalo;
  for (int i = -kHalo; i < kLeafDim + kHalo; ++i) {
    const int di = i < 0 ? 0 : (i < kLeafDim ? 1 : 2);
    for (int j = -kHalo; j < kLeafDim + kHalo; ++j) {
      const int dj = j < 0 ? 0 : (j < kLeafDim ? 1 : 2);
      if (crossOnly && di != 1 && dj != 1) continue;
      const float* const* rows = block + 9 * di + 3 * dj;
      const int from = 64 * (i & 7) + 8 * (j & 7);
      float* to = out + ((i + kHalo) * kSide + j + kHalo) * kSide;
      if (kHalo > 0 && (!crossOnly || (di == 1 && dj == 1))) {
        std::memcpy(to, rows[0] + from + kLeafDim - kHalo, sizeof(float) * kHalo);
        std::memcpy(to + kHalo + kLeafDim, rows[2] + from, sizeof(float) * kHalo);
      }
      std::memcpy(to + kHalo, rows[1] + from, sizeof(float) * kLeafDim);
    }
  }
}

// For halos of 0 to 8.
constexpr auto kCopyBox = []<int... kHalo>(std::integer_sequence<int, kHalo...>) {
  return std::array{&copyBox<kHalo>...};
}
(std::make_integer_sequence<int, kLeafDim + 1>{});

}  // namespace

void gather(const FloatTree& tree, const Coord& origin, int halo, float* out, bool crossOnly) {
  require(halo >= 0 && halo <= kLeafDim, "gather: a halo of 0 to 8 cells");
  // Blocks of one value in place of missing leaves. Few trees have more than two of them side by side; where
  // one does, a block is refilled for the next leaf.
  constexpr int kFills = 4;
  struct Fill {
    std::array<float, kLeafSize> value;
    bool filled = false;
  };
  thread_local std::array<Fill, kFills> fills;
  std::array<bool, kFills> used{};
  const auto filledWith = [&](float value) -> const float* {
    const auto bits = std::bit_cast<std::uint32_t>(value);  // tells -0 from 0, and knows NaN again
    for (int n = 0; n < kFills; ++n) {
      if (!fills[n].filled || std::bit_cast<std::uint32_t>(fills[n].value.front()) != bits) continue;
      used[n] = true;
      return fills[n].value.data();
    }
    for (int n = 0; n < kFills; ++n) {
      if (used[n]) continue;
      fills[n].value.fill(value);
      fills[n].filled = used[n] = true;
      return fills[n].value.data();
    }
    return nullptr;
  };

  const openvdb::tree::ValueAccessor<const FloatTree, false> accessor(tree);
  const float* block[27];
  // More than kFills different tiles around one leaf.
  std::vector<std::unique_ptr<std::array<float, kLeafSize>>> more;
  const int reach = halo > 0 ? 1 : 0;
  for (int di = -reach; di <= reach; ++di) {
    for (int dj = -reach; dj <= reach; ++dj) {
      for (int dk = -reach; dk <= reach; ++dk) {
        if (crossOnly && std::abs(di) + std::abs(dj) + std::abs(dk) > 1) continue;
        const Coord corner = origin.offsetBy(kLeafDim * di, kLeafDim * dj, kLeafDim * dk);
        const FloatLeaf* leaf = accessor.probeConstLeaf(corner);
        const float*& values = block[9 * (di + 1) + 3 * (dj + 1) + dk + 1];
        if (leaf != nullptr) {
          values = leaf->buffer().data();
          continue;
        }
        const float value = accessor.getValue(corner);
        values = filledWith(value);
        if (values != nullptr) continue;
        more.push_back(std::make_unique<std::array<float, kLeafSize>>());
        more.back()->fill(value);
        values = more.back()->data();
      }
    }
  }
  kCopyBox[std::min<std::size_t>(halo, kCopyBox.size() - 1)](block, out, crossOnly);
}

double maxAbs(const Velocity& velocity) {
  double largest = 0.0;
  for (const auto& grid : velocity.component) {
    const auto leaves = leavesOf(grid->constTree());
    largest = tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, leaves.size(), 16), largest,
        [&](const tbb::blocked_range<std::size_t>& range, double most) {
          for (std::size_t n = range.begin(); n != range.end(); ++n) {
            const auto& active = leaves[n]->getValueMask();
            const float* values = leaves[n]->buffer().data();
            // Eight side by side; 0 times a value that is not finite (infinity, NaN) is NaN.
            float zero[kLeafDim] = {}, highest[kLeafDim] = {};
            for (int row = 0; row < kLeafSize / kLeafDim; ++row) {
              const int on = active.getWord<std::uint8_t>(static_cast<openvdb::Index>(row));
              const float* p = values + row * kLeafDim;
              for (int k = 0; k < kLeafDim; ++k) {
                const float value = (on & 1 << k) != 0 ? std::abs(p[k]) : 0.0f;
                highest[k] = value > highest[k] ? value : highest[k];
                zero[k] += 0.0f * value;
              }
            }
            const bool finite = std::all_of(zero, zero + kLeafDim, [](float z) { return z == 0.0f; });
            const float here = finite ? *std::max_element(highest, highest + kLeafDim)
                                      : std::numeric_limits<float>::infinity();
            most = std::max(most, static_cast<double>(here));
          }
          return most;
        },
        [](double a, double b) { return std::max(a, b); });
  }
  return largest;
}

}  // namespace fluidtex::sim
