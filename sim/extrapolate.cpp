// Based on: Adalsteinsson and Sethian, "The fast construction of extension velocities in level set methods",
// 1999: grad(u) . grad(phi) = 0, discretised upwind and solved in one pass in the order of growing distance.
// The distances are known beforehand, so sorting takes the place of the marching front.
#include "sim/extrapolate.h"

#include "sim/leaf_table.h"
#include "sim/sort_by_distance.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace fluidtex::sim {
namespace {

// One component on flat arrays.
struct Component {
  const LeafTable& table;
  std::vector<float> value;         // #voxels
  std::vector<std::uint8_t> known;  // #voxels
  std::vector<float> airDistance;   // at faces, metres: phi
  std::vector<float> solidDepth;    // at faces, metres: positive inside solids

  // Mean of the known neighbours nearer to the liquid, each axis weighted by how much nearer (upwind); with
  // no such neighbour, of all known ones. False where no neighbour is known.
  bool fill(std::int64_t voxel) {
    const std::vector<float>& distance = solidDepth[voxel] > 0.0f ? solidDepth : airDistance;
    double weights = 0.0, sum = 0.0, plainSum = 0.0;
    int plainCount = 0;
    for (int axis = 0; axis < 3; ++axis) {
      double best = 0.0, bestValue = 0.0;
      for (int up = 0; up < 2; ++up) {
        const std::int64_t n = table.neighbor(voxel, 2 * axis + up);
        if (n < 0 || known[n] == 0) continue;
        plainSum += value[n];
        ++plainCount;
        const double nearer = static_cast<double>(distance[voxel]) - distance[n];
        if (nearer > best) {
          best = nearer;
          bestValue = value[n];
        }
      }
      weights += best;
      sum += best * bestValue;
    }
    if (plainCount == 0) return false;
    value[voxel] = static_cast<float>(weights > 0.0 ? sum / weights : plainSum / plainCount);
    known[voxel] = 1;
    return true;
  }
};

// Mean of a cell-centred field over the two cells of each face normal to `axis`.
std::vector<float> atFaces(const LeafTable& table, const std::vector<float>& cells, int axis) {
  std::vector<float> faces(cells.size());
  tbb::parallel_for(std::size_t{0}, table.size(), [&](std::size_t n) {
    for (std::int64_t voxel = static_cast<std::int64_t>(n) * kLeafSize, end = voxel + kLeafSize; voxel < end;
         ++voxel) {
      const std::int64_t below = table.neighbor(voxel, 2 * axis);
      faces[voxel] = below < 0 ? cells[voxel] : 0.5f * (cells[voxel] + cells[below]);
    }
  });
  return faces;
}

void extrapolateComponent(FloatGrid& grid, const MaskGrid& valid, int axis, const LeafTable& table,
                          const std::vector<float>& phi, const std::vector<float>& depth) {
  Component c{table, sampleOn(table, grid.constTree()), std::vector<std::uint8_t>(table.voxels()),
              atFaces(table, phi, axis), atFaces(table, depth, axis)};
  const auto leaves = leavesOf(grid.tree());
  // Faces in solids come after those in the air, so that both sides of a contact line are known first.
  std::vector<FarVoxel> order;
  for (std::size_t n = 0; n < leaves.size(); ++n) {
    const auto* validLeaf = valid.constTree().probeConstLeaf(leaves[n]->origin());
    const bool validTile = validLeaf == nullptr && valid.constTree().isValueOn(leaves[n]->origin());
    for (int offset = 0; offset < kLeafSize; ++offset) {
      if (!leaves[n]->isValueOn(offset)) continue;
      const std::int64_t voxel = static_cast<std::int64_t>(n) * kLeafSize + offset;
      if (validTile || (validLeaf != nullptr && validLeaf->isValueOn(offset))) {
        c.known[voxel] = 1;
      } else {
        const bool inSolid = c.solidDepth[voxel] > 0.0f;
        order.push_back({sortKey(inSolid ? c.solidDepth[voxel] : c.airDistance[voxel], inSolid),
                         static_cast<std::uint32_t>(voxel)});
      }
    }
  }
  sortByDistance(order);

  // One pass does nearly all; local minima of the distance that hold no valid face wait for their neighbours.
  std::vector<std::int64_t> waiting;
  for (const FarVoxel& e : order) {
    if (!c.fill(e.voxel)) waiting.push_back(e.voxel);
  }
  while (!waiting.empty()) {
    std::vector<std::int64_t> still;
    for (const std::int64_t voxel : waiting) {
      if (!c.fill(voxel)) still.push_back(voxel);
    }
    if (still.size() == waiting.size()) break;
    waiting.swap(still);
  }
  for (const std::int64_t voxel : waiting) c.value[voxel] = 0.0f;

  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    std::copy_n(c.value.data() + n * kLeafSize, kLeafSize, leaves[n]->buffer().data());
  });
}

}  // namespace

void extrapolate(const std::vector<Extrapolated>& fields, const FloatGrid& phi, const FloatGrid& solidPhi) {
  const LeafTable table = makeLeafTable(fields.front().field.component[0]->constTree());
  const std::vector<float> cellPhi = sampleOn(table, phi.constTree());
  std::vector<float> depth = sampleOn(table, solidPhi.constTree());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, depth.size(), kLeafSize), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) depth[i] = -depth[i];
  });
  const int count = 3 * static_cast<int>(fields.size());
  // One component a task: each is a long sweep of one thread.
  tbb::parallel_for(
      tbb::blocked_range<int>(0, count, 1),
      [&](const tbb::blocked_range<int>& range) {
        for (int n = range.begin(); n != range.end(); ++n) {
          const auto& [field, valid] = fields[n / 3];
          const MaskGrid* const masks[3] = {valid.u.get(), valid.v.get(), valid.w.get()};
          extrapolateComponent(*field.component[n % 3], *masks[n % 3], n % 3, table, cellPhi, depth);
        }
      },
      tbb::simple_partitioner());
}

void extrapolate(Velocity& velocity, const FaceMasks& valid, const FloatGrid& phi,
                 const FloatGrid& solidPhi) {
  extrapolate({{velocity, valid}}, phi, solidPhi);
}

}  // namespace fluidtex::sim
