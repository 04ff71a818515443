#include "sim/surface/level_set.h"

#include "sim/grid/leaf_table.h"
#include "sim/grid/require.h"
#include "sim/solids/chunks.h"
#include "sim/solids/solid_layers.h"
#include "sim/surface/cell_volume.h"
#include "sim/surface/redistance.h"

#include <openvdb/tools/Prune.h>

#include <tbb/parallel_for.h>

#include <algorithm>
#include <memory>
#include <numeric>
#include <stdexcept>

namespace fluidtex::sim {
namespace {

// Builds a level set from blocks: fill(origin, values) writes the 512 values of a block. Blocks beyond the
// narrow band become tiles.
template <class Fill>
void build(FloatTree& tree, const std::vector<Coord>& origins, const Fill& fill) {
  const float background = tree.background();
  std::vector<std::unique_ptr<FloatLeaf>> leaves(origins.size());
  std::vector<std::uint8_t> inside(origins.size());
  tbb::parallel_for(std::size_t{0}, origins.size(), [&](std::size_t n) {
    auto leaf = std::make_unique<FloatLeaf>(origins[n], background, true);
    float* values = leaf->buffer().data();
    fill(origins[n], values);
    bool near = false;
    for (int i = 0; i < kLeafSize; ++i) {
      values[i] = std::clamp(values[i], -background, background);
      near = near || std::abs(values[i]) < background;
    }
    near = near ||
           std::any_of(values, values + kLeafSize, [&](float v) { return (v < 0.0f) != (values[0] < 0.0f); });
    inside[n] = values[0] < 0.0f;
    if (near) leaves[n] = std::move(leaf);
  });
  for (std::size_t n = 0; n < origins.size(); ++n) {
    if (leaves[n]) {
      tree.addLeaf(leaves[n].release());
    } else {
      tree.addTile(1, origins[n], inside[n] != 0 ? -background : background, false);
    }
  }
}

// Sum of value(phi, solid) over the cells of the domain that may hold liquid.
template <class Value>
double sumOverCells(const FloatGrid& phi, const SolidField& solid, const Value& value) {
  const auto origins = wetLeaves(phi, solid.domain);
  std::vector<double> sums(origins.size());
  tbb::parallel_for(std::size_t{0}, origins.size(), [&](std::size_t n) {
    float phiScratch[kLeafSize], solidScratch[kLeafSize];
    const float* p = leafValues(phi.constTree(), origins[n], phiScratch);
    const float* s = leafValues(solid.phi->constTree(), origins[n], solidScratch);
    const Coord last = solid.domain.max() + Coord(1) - origins[n];
    for (int i = 0; i < std::min(kLeafDim, last.x()); ++i) {
      for (int j = 0; j < std::min(kLeafDim, last.y()); ++j) {
        for (int k = 0; k < std::min(kLeafDim, last.z()); ++k) {
          sums[n] += value(p[64 * i + 8 * j + k], s[64 * i + 8 * j + k]);
        }
      }
    }
  });
  double sum = 0.0;
  for (const double part : sums) sum += part;
  return sum;
}

void setBand(FloatTree& tree, const FloatTree* solidPhi, float h) {
  const float background = tree.background();
  const auto leaves = leavesOf(tree);
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    float scratch[kLeafSize] = {};
    const float* solid = solidPhi != nullptr ? leafValues(*solidPhi, leaves[n]->origin(), scratch) : scratch;
    float* values = leaves[n]->buffer().data();
    for (int i = 0; i < kLeafSize; ++i) {
      const bool on = std::abs(values[i]) < background && solid[i] > -kSolidLayers * h;
      leaves[n]->setActiveState(i, on);
      if (!on) values[i] = values[i] < 0.0f ? -background : background;
    }
  });
  // Not pruneLevelSet: it turns a node without leaves into one tile, and behind walls such nodes hold both
  // signs.
  openvdb::tools::prune(tree);
}

}  // namespace

int bandWidth(double cfl) {
  return std::max(6, static_cast<int>(std::ceil(std::min(cfl, kMaxTrace))) + 4);
}

void cutSolids(FloatGrid& phi, const FloatGrid& solidPhi, const MaskGrid& where) {
  const float background = phi.background();
  openvdb::tree::ValueAccessor<FloatTree> accessor(phi.tree());
  const auto solid = solidPhi.getConstUnsafeAccessor();
  for (auto leaf = where.constTree().cbeginLeaf(); leaf; ++leaf) {
    for (auto it = leaf->cbeginValueOn(); it; ++it) {
      const float cut = std::max(accessor.getValue(it.getCoord()), -solid.getValue(it.getCoord()));
      accessor.setValue(it.getCoord(), std::clamp(cut, -background, background));
    }
  }
}

void trimBand(FloatGrid& phi, const FloatGrid& solidPhi) {
  setBand(phi.tree(), &solidPhi.constTree(), static_cast<float>(phi.voxelSize()[0]));
}

void unite(FloatGrid& phi, const std::function<double(const Vec3d&)>& distance, const CoordBBox& within) {
  const double h = phi.voxelSize()[0], background = phi.background();
  // Where a whole cube of cells is beyond the narrow band, the sign at its centre is that of all its cells.
  const auto sideOf = [&](const Coord& origin, int size) {
    const double d = distance(phi.indexToWorld(origin.asVec3d() + Vec3d(0.5 * (size - 1))));
    const double farthest = background + 0.5 * std::sqrt(3.0) * (size - 1) * h;
    return d > farthest ? 1 : d < -farthest ? -1 : 0;
  };
  const Coord low = leafOrigin(within.min()), &high = within.max();
  const Chunks chunks = within.empty() ? Chunks() : chunksIn(within);
  std::vector<std::vector<Coord>> parts(chunks.size());
  tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t n) {
    if (sideOf(chunks[n], kChunkDim) > 0) return;
    CoordBBox box = CoordBBox::createCube(chunks[n], kChunkDim);
    box.intersect({low, high});
    for (int i = box.min().x(); i <= box.max().x(); i += kLeafDim)
      for (int j = box.min().y(); j <= box.max().y(); j += kLeafDim)
        for (int k = box.min().z(); k <= box.max().z(); k += kLeafDim)
          if (sideOf(Coord(i, j, k), kLeafDim) <= 0) parts[n].emplace_back(i, j, k);
  });
  std::vector<Coord> origins;
  for (const auto& part : parts) origins.insert(origins.end(), part.begin(), part.end());
  FloatTree united(phi.background());
  build(united, origins, [&](const Coord& origin, float* values) {
    if (sideOf(origin, kLeafDim) < 0) {
      std::fill_n(values, kLeafSize, static_cast<float>(-background));
      return;
    }
    const float* was = leafValues(phi.constTree(), origin, values);
    if (was != values) std::copy_n(was, kLeafSize, values);
    for (int i = 0; i < kLeafSize; ++i) {
      const Coord ijk = origin.offsetBy(i >> 6, (i >> 3) & 7, i & 7);
      values[i] = std::min(values[i], static_cast<float>(distance(phi.indexToWorld(ijk))));
    }
  });
  for (const Coord& origin : origins) {
    const float value = united.getValue(origin);
    if (FloatLeaf* leaf = united.stealNode<FloatLeaf>(origin, phi.background(), false)) {
      phi.tree().addLeaf(leaf);
    } else {
      phi.tree().addTile(1, origin, value, false);
    }
  }
  for (FloatLeaf* leaf : leavesOf(phi.tree())) leaf->setValuesOn();
}

void unite(FloatGrid& phi, const ShapeDistance& shape, const CoordBBox& domain,
           const std::function<double(const Vec3d&)>& distance) {
  const double h = phi.voxelSize()[0];
  const CoordBBox reach = grown(domain, kLeafDim);
  openvdb::BBoxd room(reach.min().asVec3d() * h, reach.max().offsetBy(1).asVec3d() * h);
  for (int a = 0; a < 3; ++a) {
    if (domain.min()[a] <= -kEndless) room.min()[a] = -kForever;
    if (domain.max()[a] >= kEndless - 1) room.max()[a] = kForever;
  }
  room = shape.boundsIn(room);
  if (room.empty()) return;
  CoordBBox within = grown(cellsIn(room, h), static_cast<int>(std::ceil(phi.background() / h)) + 1);
  within.intersect(reach);
  if (!within.empty() && isEndless(within))
    throw std::invalid_argument("a shape has no end on a side on which the domain has none");
  unite(
      phi, distance ? distance : [&](const Vec3d& x) { return shape(x); }, within);
}

FloatGrid::Ptr visibleSurface(const FloatGrid& phi, const SolidField& solid, int halfWidth) {
  require(halfWidth > 0, "visibleSurface: a band of at least one voxel");
  const double h = phi.voxelSize()[0];
  FloatGrid::Ptr surface = makePhi(h, halfWidth * h);
  surface->setName("surface");
  const float background = surface->background();
  build(surface->tree(), wetLeaves(phi, grown(solid.domain, kLeafDim)),
        [&](const Coord& origin, float* values) {
          float scratch[kLeafSize];
          const float* p = leafValues(phi.constTree(), origin, scratch);
          const float* s = leafValues(solid.phi->constTree(), origin, values);
          // The solid's distance is clamped at 3 h: beyond, only its sign is known.
          for (int i = 0; i < kLeafSize; ++i) {
            const float outside = s[i] >= static_cast<float>(2.999 * h) ? -background : -s[i];
            values[i] = std::max(p[i], outside);
          }
        });
  const auto nothing = FloatGrid::create(static_cast<float>(3.0 * h));
  redistance(*surface, *nothing, 2 * halfWidth + 2);
  setBand(surface->tree(), nullptr, static_cast<float>(h));
  return surface;
}

double liquidVolume(const FloatGrid& phi, const SolidField& solid) {
  const auto origins = wetLeaves(phi, solid.domain);
  std::vector<double> sums(origins.size());
  tbb::parallel_for(std::size_t{0}, origins.size(), [&](std::size_t n) {
    LeafShares liquid;
    liquidShares(phi, solid, origins[n], liquid);
    const Coord last = solid.domain.max() + Coord(1) - origins[n];
    for (int i = 0; i < std::min(kLeafDim, last.x()); ++i)
      for (int j = 0; j < std::min(kLeafDim, last.y()); ++j)
        for (int k = 0; k < std::min(kLeafDim, last.z()); ++k) sums[n] += liquid[64 * i + 8 * j + k];
  });
  const double h = phi.voxelSize()[0];
  return std::accumulate(sums.begin(), sums.end(), 0.0) * h * h * h;
}

std::int64_t liquidCells(const FloatGrid& phi, const SolidField& solid) {
  return static_cast<std::int64_t>(
      sumOverCells(phi, solid, [](float p, float s) { return p < 0.0f && s >= 0.0f ? 1.0 : 0.0; }));
}

}  // namespace fluidtex::sim
