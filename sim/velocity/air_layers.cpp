#include "sim/velocity/air_layers.h"

#include "sim/grid/leaf_table.h"
#include "sim/grid/voxel_mask.h"
#include "sim/solids/table_sight.h"

#include <algorithm>

namespace fluidtex::sim {
namespace {

constexpr int kLayers = 2;
// Sweeps over a layer: its cells share faces where the surface is oblique.
constexpr int kSweeps = 2;
constexpr float kMostGrowth = 1.5f;
// Linear extrapolation changes a value by no more than this share of itself: beside jets the slope is not
// that of the flow.
constexpr float kMostSlope = 0.2f;
// Layers of faces that are extrapolated linearly: those that cubic interpolation of advection reads.
constexpr int kLinearLayers = 2;
// The faces away from the liquid must lead at least this much farther from it, in cells, to take the
// divergence.
constexpr float kLeastWay = 0.5f;

struct Layers {
  const LeafTable& table;
  const TableSight& sight;
  float h;
  std::vector<float> phi;                      // #voxels, metres
  std::array<std::vector<float*>, 3> speed{};  // by leaf: of its lower faces, m/s
  std::array<VoxelMask, 3> free{};             // the face may be changed
  std::array<VoxelMask, kLayers> layer{};      // the cells of each
  std::vector<float> change{}, bound{};        // #voxels: of the layer at work, 0 elsewhere

  float& speedAt(int axis, std::int64_t face) const { return speed[axis][face >> 9][face & 511]; }
  // Nothing passes a face in a thin wall at rest; its value is that of neither side.
  float passing(int axis, std::int64_t face) const {
    return sight.inWall(face, axis) ? 0.0f : speedAt(axis, face);
  }

  // How much farther from the liquid the cell behind a face (towards direction 0..5) is; 0 where the face is
  // not free.
  float way(std::int64_t cell, int direction) const {
    const std::int64_t beyond = sight.cell(cell, direction);
    if (beyond < 0) return 0.0f;
    const std::int64_t face = (direction & 1) != 0 ? beyond : cell;
    return isSet(free[direction >> 1], face) ? std::max(0.0f, phi[beyond] - phi[cell]) : 0.0f;
  }

  // The correction of a cell's faces that lie farther from the liquid, in m/s for each metre that they lead
  // farther.
  float balance(std::int64_t cell) const {
    float divergence = 0.0f, ways = 0.0f;
    for (int axis = 0; axis < 3; ++axis) {
      const std::int64_t up = table.neighbor(cell, 2 * axis + 1);
      if (up < 0) return 0.0f;
      divergence += passing(axis, up) - passing(axis, cell);
      ways += way(cell, 2 * axis) + way(cell, 2 * axis + 1);
    }
    return ways > kLeastWay * h ? -divergence / ways : 0.0f;
  }

  float largest(std::int64_t cell) const {
    float most = 0.0f;
    for (int axis = 0; axis < 3; ++axis) {
      const std::int64_t up = table.neighbor(cell, 2 * axis + 1);
      most = std::max(most, std::abs(passing(axis, cell)));
      if (up >= 0) most = std::max(most, std::abs(passing(axis, up)));
    }
    return most;
  }
};

// Keeps those of a leaf's cells that are beside set ones on their own side of walls.
void dropHidden(const TableSight& sight, const VoxelMask& mask, std::size_t leaf, LeafBits& cells) {
  if (!sight.any(leaf)) return;
  LeafBits seen{};
  forBits(cells, leaf, [&](std::int64_t cell) {
    for (int direction = 0; direction < 6; ++direction) {
      const std::int64_t next = sight.cell(cell, direction);
      if (next >= 0 && isSet(mask, next)) return setBit(seen, cell);
    }
  });
  cells = seen;
}

// Finds the layers. The first one touches liquid, each next one the layer before.
void number(Layers& layers, const VoxelMask& liquid, const VoxelMask& open) {
  VoxelMask taken = liquid;
  for (int n = 0; n < kLayers; ++n) {
    const VoxelMask& before = n == 0 ? liquid : layers.layer[n - 1];
    VoxelMask& layer = layers.layer[n];
    layer.resize(layers.table.size());
    forLeaves(layers.table, [&](std::size_t leaf) {
      layer[leaf] = besideAny(layers.table, before, leaf);
      dropHidden(layers.sight, before, leaf, layer[leaf]);
      for (std::size_t i = 0; i < layer[leaf].size(); ++i) {
        layer[leaf][i] &= open[leaf][i] & ~taken[leaf][i];
        taken[leaf][i] |= layer[leaf][i];
      }
    });
  }
}

// Makes the cells of one layer divergence-free, all at once.
void balance(Layers& layers, const VoxelMask& layer) {
  const LeafTable& table = layers.table;
  forLeaves(table, [&](std::size_t leaf) {
    forBits(layer[leaf], leaf, [&](std::int64_t cell) {
      layers.change[cell] = layers.balance(cell);
      layers.bound[cell] = kMostGrowth * layers.largest(cell);
    });
  });
  for (int axis = 0; axis < 3; ++axis) {
    forLeaves(table, [&](std::size_t leaf) {
      LeafBits faces = besideThose(table, layer, leaf, 2 * axis);
      for (std::size_t i = 0; i < faces.size(); ++i) faces[i] |= layer[leaf][i];
      forBits(faces, leaf, [&](std::int64_t cell) {
        const std::int64_t below = table.neighbor(cell, 2 * axis);
        if (below < 0) return;
        const float fromBelow =
            layers.change[below] == 0.0f ? 0.0f : layers.change[below] * layers.way(below, 2 * axis + 1);
        const float fromHere =
            layers.change[cell] == 0.0f ? 0.0f : layers.change[cell] * layers.way(cell, 2 * axis);
        if (fromBelow == 0.0f && fromHere == 0.0f) return;
        float& speed = layers.speedAt(axis, cell);
        const float most = std::max({layers.bound[below], layers.bound[cell], std::abs(speed)});
        speed = std::clamp(speed + fromBelow - fromHere, -most, most);
      });
    });
  }
  forLeaves(table, [&](std::size_t leaf) {
    forBits(layer[leaf], leaf, [&](std::int64_t cell) { layers.change[cell] = layers.bound[cell] = 0.0f; });
  });
}

std::vector<float*> valuesOf(FloatTree& tree) {
  std::vector<float*> values;
  for (FloatLeaf* leaf : leavesOf(tree)) values.push_back(leaf->buffer().data());
  return values;
}

}  // namespace

void balanceAirLayers(Velocity& velocity, const FaceMasks& valid, const FloatGrid& phi,
                      const FloatGrid& solidPhi, const Visibility* visibility) {
  const LeafTable table = makeLeafTable(velocity.component[0]->constTree());
  const TableSight sight(table, visibility);
  Layers layers{table, sight, static_cast<float>(phi.voxelSize()[0]), sampleOn(table, phi.constTree())};
  layers.change.resize(table.voxels());
  layers.bound.resize(table.voxels());
  const VoxelMask liquid = maskOf(table, layers.phi, [](float p) { return p < 0.0f; });
  const VoxelMask open =
      maskOf(table, sampleOn(table, solidPhi.constTree()), [](float s) { return s > 0.0f; });
  number(layers, liquid, open);
  const auto& masks = valid.component;
  for (int axis = 0; axis < 3; ++axis) {
    layers.speed[axis] = valuesOf(velocity.component[axis]->tree());
    VoxelMask& free = layers.free[axis];
    free.resize(table.size());
    forLeaves(table, [&](std::size_t n) {
      free[n] = besideThose(table, open, n, 2 * axis);
      const auto* known = masks[axis]->constTree().probeConstLeaf(table.origins[n]);
      for (std::size_t i = 0; i < free[n].size(); ++i) {
        free[n][i] &= open[n][i];
        if (known != nullptr)
          free[n][i] &= ~known->getValueMask().getWord<std::uint64_t>(static_cast<openvdb::Index>(i));
      }
    });
  }
  for (const VoxelMask& layer : layers.layer)
    for (int sweep = 0; sweep < kSweeps; ++sweep) balance(layers, layer);
}

void extendLinearly(Velocity& values, const FloatGrid& phi, const Visibility* visibility) {
  const LeafTable table = makeLeafTable(values.component[0]->constTree());
  const TableSight sight(table, visibility);
  const std::vector<float> cellPhi = sampleOn(table, phi.constTree());
  const VoxelMask liquid = maskOf(table, cellPhi, [](float p) { return p < 0.0f; });
  for (int axis = 0; axis < 3; ++axis) {
    VoxelMask touching(table.size());
    forLeaves(table, [&](std::size_t n) {
      touching[n] = besideThose(table, liquid, n, 2 * axis);
      for (std::size_t i = 0; i < touching[n].size(); ++i) touching[n][i] |= liquid[n][i];
    });
    const auto below = [&](std::int64_t face) {
      const std::int64_t cell = table.neighbor(face, 2 * axis);
      return cellPhi[cell < 0 ? face : cell];
    };
    const std::vector<float*> value = valuesOf(values.component[axis]->tree());
    const auto valueAt = [&](std::int64_t face) -> float& { return value[face >> 9][face & 511]; };
    VoxelMask known = std::move(touching);
    for (int layer = 0; layer < kLinearLayers; ++layer) {
      VoxelMask beyond(table.size());
      // Values are read where they are known and written elsewhere only.
      forLeaves(table, [&](std::size_t n) {
        beyond[n] = besideAny(table, known, n);
        for (std::size_t i = 0; i < beyond[n].size(); ++i) beyond[n][i] &= ~known[n][i];
        forBits(beyond[n], n, [&](std::int64_t face) {
          const float here = cellPhi[face] + below(face);
          float weights = 0.0f, sum = 0.0f, count = 0.0f, plain = 0.0f;
          for (int direction = 0; direction < 6; ++direction) {
            const std::int64_t near = sight.face(face, axis, direction);
            if (near < 0 || !isSet(known, near)) continue;
            count += 1.0f;
            plain += valueAt(near);
            const std::int64_t behind = sight.face(near, axis, direction);
            if (behind < 0 || !isSet(known, behind)) continue;
            const float nearer = here - cellPhi[near] - below(near);
            if (nearer <= 0.0f) continue;
            weights += nearer;
            const float most = kMostSlope * std::max(std::abs(valueAt(near)), std::abs(valueAt(behind)));
            sum += nearer * (valueAt(near) + std::clamp(valueAt(near) - valueAt(behind), -most, most));
          }
          if (count > 0.0f) valueAt(face) = weights > 0.0f ? sum / weights : plain / count;
        });
      });
      forLeaves(table, [&](std::size_t n) {
        for (std::size_t i = 0; i < known[n].size(); ++i) known[n][i] |= beyond[n][i];
      });
    }
  }
}

}  // namespace fluidtex::sim
