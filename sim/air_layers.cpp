#include "sim/air_layers.h"

#include "sim/leaf_table.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace fluidtex::sim {
namespace {

constexpr int kLayers = 2;
// Cells of one layer share faces where the surface is slanted.
constexpr int kSweeps = 2;
constexpr float kMostGrowth = 1.5f;
// What goes on linearly changes by no more than this share of itself: beside jets the slope is no flow's.
constexpr float kMostSlope = 0.2f;
// The faces away from the liquid have to lead that much farther from it, in cells, to take on the divergence.
constexpr float kLeastWay = 0.5f;

struct Layers {
  LeafTable table{};
  float h = 0.0f;
  std::vector<float> phi{}, solid{};                // #voxels, metres
  std::array<std::vector<float>, 3> speed{};        // #voxels, m/s, at lower faces
  std::array<std::vector<std::uint8_t>, 3> free{};  // #voxels: the face may be changed
  std::vector<std::uint8_t> layer{};                // #voxels: 0 none, else 1..kLayers

  // Whether the face of a cell towards direction 0..5 is free, and how much farther from the liquid the cell
  // behind it is.
  float way(std::int64_t cell, int direction) const {
    const std::int64_t beyond = table.neighbor(cell, direction);
    if (beyond < 0) return 0.0f;
    const std::int64_t face = (direction & 1) != 0 ? beyond : cell;
    return free[direction >> 1][face] != 0 ? std::max(0.0f, phi[beyond] - phi[cell]) : 0.0f;
  }

  // What a cell adds to the faces that lie farther from the liquid, in m/s for each metre of their way.
  float balance(std::int64_t cell) const {
    float divergence = 0.0f, ways = 0.0f;
    for (int axis = 0; axis < 3; ++axis) {
      const std::int64_t up = table.neighbor(cell, 2 * axis + 1);
      if (up < 0) return 0.0f;
      divergence += speed[axis][up] - speed[axis][cell];
      ways += way(cell, 2 * axis) + way(cell, 2 * axis + 1);
    }
    return ways > kLeastWay * h ? -divergence / ways : 0.0f;
  }

  float largest(std::int64_t cell) const {
    float most = 0.0f;
    for (int axis = 0; axis < 3; ++axis) {
      const std::int64_t up = table.neighbor(cell, 2 * axis + 1);
      most = std::max(most, std::abs(speed[axis][cell]));
      if (up >= 0) most = std::max(most, std::abs(speed[axis][up]));
    }
    return most;
  }

  template <typename Body>
  void forVoxels(const Body& body) const {
    tbb::parallel_for(std::size_t{0}, table.size(), [&](std::size_t n) {
      const std::int64_t first = static_cast<std::int64_t>(n) * kLeafSize;
      for (std::int64_t voxel = first; voxel < first + kLeafSize; ++voxel) body(voxel);
    });
  }
};

// The first layer touches liquid, each next one the layer before.
void number(Layers& layers) {
  layers.layer.assign(layers.table.voxels(), 0);
  for (int layer = 1; layer <= kLayers; ++layer) {
    const std::vector<std::uint8_t> before = layers.layer;
    layers.forVoxels([&](std::int64_t cell) {
      if (layers.phi[cell] < 0.0f || layers.solid[cell] <= 0.0f || before[cell] != 0) return;
      for (int direction = 0; direction < 6; ++direction) {
        const std::int64_t beside = layers.table.neighbor(cell, direction);
        if (beside < 0) continue;
        const bool touches = layer == 1 ? layers.phi[beside] < 0.0f : before[beside] == layer - 1;
        if (touches) layers.layer[cell] = static_cast<std::uint8_t>(layer);
      }
    });
  }
}

// Takes the divergence out of the cells of one layer, all at once.
void balance(Layers& layers, int layer) {
  std::vector<float> change(layers.table.voxels()), bound(layers.table.voxels());
  layers.forVoxels([&](std::int64_t cell) {
    if (layers.layer[cell] != layer) return;
    change[cell] = layers.balance(cell);
    bound[cell] = kMostGrowth * layers.largest(cell);
  });
  const LeafTable& table = layers.table;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<float>& speed = layers.speed[axis];
    layers.forVoxels([&](std::int64_t cell) {
      const std::int64_t below = table.neighbor(cell, 2 * axis);
      if (below < 0) return;
      const float fromBelow = change[below] == 0.0f ? 0.0f : change[below] * layers.way(below, 2 * axis + 1);
      const float fromHere = change[cell] == 0.0f ? 0.0f : change[cell] * layers.way(cell, 2 * axis);
      if (fromBelow == 0.0f && fromHere == 0.0f) return;
      const float most = std::max({bound[below], bound[cell], std::abs(speed[cell])});
      speed[cell] = std::clamp(speed[cell] + fromBelow - fromHere, -most, most);
    });
  }
}

}  // namespace

void balanceAirLayers(Velocity& velocity, const FaceMasks& valid, const FloatGrid& phi,
                      const FloatGrid& solidPhi) {
  Layers layers{.table = makeLeafTable(velocity.component[0]->constTree()),
                .h = static_cast<float>(phi.voxelSize()[0])};
  layers.phi = sampleOn(layers.table, phi.constTree());
  layers.solid = sampleOn(layers.table, solidPhi.constTree());
  number(layers);
  const MaskGrid* const masks[3] = {valid.u.get(), valid.v.get(), valid.w.get()};
  for (int axis = 0; axis < 3; ++axis) {
    layers.speed[axis] = sampleOn(layers.table, velocity.component[axis]->constTree());
    layers.free[axis].resize(layers.table.voxels());
    tbb::parallel_for(std::size_t{0}, layers.table.size(), [&](std::size_t n) {
      const auto* known = masks[axis]->constTree().probeConstLeaf(layers.table.origins[n]);
      for (int i = 0; i < kLeafSize; ++i) {
        const std::int64_t face = static_cast<std::int64_t>(n) * kLeafSize + i;
        const std::int64_t below = layers.table.neighbor(face, 2 * axis);
        layers.free[axis][face] = below >= 0 && layers.solid[face] > 0.0f && layers.solid[below] > 0.0f &&
                                  (known == nullptr || !known->isValueOn(i));
      }
    });
  }
  for (int layer = 1; layer <= kLayers; ++layer)
    for (int sweep = 0; sweep < kSweeps; ++sweep) balance(layers, layer);
  for (int axis = 0; axis < 3; ++axis) {
    const auto leaves = leavesOf(velocity.component[axis]->tree());
    tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
      std::copy_n(layers.speed[axis].data() + n * kLeafSize, kLeafSize, leaves[n]->buffer().data());
    });
  }
}

void extendLinearly(Velocity& values, const FloatGrid& phi) {
  const LeafTable table = makeLeafTable(values.component[0]->constTree());
  const std::vector<float> cellPhi = sampleOn(table, phi.constTree());
  for (int axis = 0; axis < 3; ++axis) {
    const auto below = [&](std::int64_t face) {
      const std::int64_t cell = table.neighbor(face, 2 * axis);
      return cellPhi[cell < 0 ? face : cell];
    };
    const auto touchesLiquid = [&](std::int64_t face) { return cellPhi[face] < 0.0f || below(face) < 0.0f; };
    const std::vector<float> was = sampleOn(table, values.component[axis]->constTree());
    const auto leaves = leavesOf(values.component[axis]->tree());
    tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
      float* out = leaves[n]->buffer().data();
      for (int i = 0; i < kLeafSize; ++i) {
        const std::int64_t face = static_cast<std::int64_t>(n) * kLeafSize + i;
        if (touchesLiquid(face)) continue;
        const float here = cellPhi[face] + below(face);
        float weights = 0.0f, sum = 0.0f;
        for (int direction = 0; direction < 6; ++direction) {
          const std::int64_t near = table.neighbor(face, direction);
          if (near < 0 || !touchesLiquid(near)) continue;
          const std::int64_t behind = table.neighbor(near, direction);
          if (behind < 0 || !touchesLiquid(behind)) continue;
          const float nearer = here - cellPhi[near] - below(near);
          if (nearer <= 0.0f) continue;
          weights += nearer;
          const float most = kMostSlope * std::max(std::abs(was[near]), std::abs(was[behind]));
          sum += nearer * (was[near] + std::clamp(was[near] - was[behind], -most, most));
        }
        if (weights > 0.0f) out[i] = sum / weights;
      }
    });
  }
}

}  // namespace fluidtex::sim
