// Based on: Adalsteinsson and Sethian, "The fast construction of extension velocities in level set methods",
// 1999: grad(u) . grad(phi) = 0, discretised upwind and solved in one pass in the order of growing distance.
// The distances are known beforehand, so sorting takes the place of the marching front.
#include "sim/velocity/extrapolate.h"

#include "sim/grid/leaf_table.h"
#include "sim/grid/require.h"
#include "sim/grid/sort_by_distance.h"
#include "sim/solids/table_sight.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

namespace fluidtex::sim {
namespace {

// The components along one axis of kFields fields, side by side on flat arrays.
template <int kFields>
struct Sweep {
  const TableSight& sight;
  const int normal;                               // axis of the faces' normals
  std::vector<float> airDistance, solidDepth;     // #voxels, at faces, metres: phi; positive inside solids
  std::vector<std::array<float, kFields>> value;  // #voxels
  std::vector<std::uint8_t> known;                // #voxels: bit n says whether field n is known
  static constexpr std::uint8_t kAll = (1 << kFields) - 1;

  // Sets each field that is not known to the mean of the known neighbours nearer to the liquid, each axis
  // weighted by the difference in distance (upwind); with no such neighbour, of all known ones. False where
  // no neighbour is known.
  bool fill(std::int64_t voxel) {
    const std::vector<float>& distance = solidDepth[voxel] > 0.0f ? solidDepth : airDistance;
    double weights[kFields] = {}, sum[kFields] = {}, plainSum[kFields] = {};
    int plainCount[kFields] = {};
    for (int axis = 0; axis < 3; ++axis) {
      double best[kFields] = {}, bestValue[kFields] = {};
      for (int up = 0; up < 2; ++up) {
        const std::int64_t n = sight.face(voxel, normal, 2 * axis + up);
        if (n < 0 || known[n] == 0) continue;
        const double nearer = static_cast<double>(distance[voxel]) - distance[n];
        for (int f = 0; f < kFields; ++f) {
          if ((known[n] >> f & 1) == 0) continue;
          plainSum[f] += value[n][f];
          ++plainCount[f];
          if (nearer > best[f]) {
            best[f] = nearer;
            bestValue[f] = value[n][f];
          }
        }
      }
      for (int f = 0; f < kFields; ++f) {
        weights[f] += best[f];
        sum[f] += best[f] * bestValue[f];
      }
    }
    const std::uint8_t before = known[voxel];
    for (int f = 0; f < kFields; ++f) {
      if ((before >> f & 1) != 0 || plainCount[f] == 0) continue;
      value[voxel][f] =
          static_cast<float>(weights[f] > 0.0 ? sum[f] / weights[f] : plainSum[f] / plainCount[f]);
      known[voxel] |= 1 << f;
    }
    return known[voxel] != before;
  }
};

// Mean of a cell-centred field over the two cells of each face normal to `axis`.
std::vector<float> atFaces(const LeafTable& table, const std::vector<float>& cells, int axis) {
  std::vector<float> faces(cells.size());
  const int shift = 6 - 3 * axis, stride = 1 << shift;
  tbb::parallel_for(std::size_t{0}, table.size(), [&](std::size_t n) {
    const float* here = cells.data() + n * kLeafSize;
    const int below = table.next[n][2 * axis];
    // Without a leaf below, the cell itself replaces the one below it.
    const float* before = below < 0 ? here : cells.data() + below * std::size_t{kLeafSize} + 7 * stride;
    float* out = faces.data() + n * kLeafSize;
    for (int i = 0; i < kLeafSize; ++i)
      out[i] = 0.5f * (here[i] + ((i >> shift & 7) == 0 ? before[i] : here[i - stride]));
  });
  return faces;
}

template <int kFields>
void extrapolateAxis(const std::vector<Extrapolated>& fields, int axis, const LeafTable& table,
                     const TableSight& sight, const std::vector<float>& phi,
                     const std::vector<float>& depth) {
  Sweep<kFields> s{sight,
                   axis,
                   atFaces(table, phi, axis),
                   atFaces(table, depth, axis),
                   std::vector<std::array<float, kFields>>(table.voxels()),
                   std::vector<std::uint8_t>(table.voxels())};
  std::array<std::vector<FloatLeaf*>, kFields> leaves;
  for (int f = 0; f < kFields; ++f) leaves[f] = leavesOf(fields[f].field.component[axis]->tree());
  tbb::parallel_for(std::size_t{0}, table.size(), [&](std::size_t n) {
    for (int f = 0; f < kFields; ++f) {
      const auto& masks = fields[f].valid;
      const MaskTree& valid = masks[axis].constTree();
      const auto* validLeaf = valid.probeConstLeaf(table.origins[n]);
      const bool validTile = validLeaf == nullptr && valid.isValueOn(table.origins[n]);
      const float* from = leaves[f][n]->buffer().data();
      for (int i = 0; i < kLeafSize; ++i) {
        s.value[n * kLeafSize + i][f] = from[i];
        const bool isKnown = validLeaf != nullptr ? validLeaf->isValueOn(i) : validTile;
        if (isKnown && leaves[f][n]->isValueOn(i)) s.known[n * kLeafSize + i] |= 1 << f;
      }
    }
  });
  // Faces in solids come after those in the air, so that both sides of a contact line are known first.
  std::vector<FarVoxel> order;
  for (std::size_t n = 0; n < table.size(); ++n) {
    for (auto it = leaves[0][n]->cbeginValueOn(); it; ++it) {
      const std::size_t voxel = n * kLeafSize + it.pos();
      if (s.known[voxel] == s.kAll) continue;
      const bool inSolid = s.solidDepth[voxel] > 0.0f;
      order.push_back({sortKey(inSolid ? s.solidDepth[voxel] : s.airDistance[voxel], inSolid),
                       static_cast<std::uint32_t>(voxel)});
    }
  }
  sortByDistance(order);

  // One pass fills nearly all faces; local minima of the distance that hold no valid face wait for their
  // neighbours.
  std::vector<std::int64_t> waiting;
  for (const FarVoxel& e : order) {
    s.fill(e.voxel);
    if (s.known[e.voxel] != s.kAll) waiting.push_back(e.voxel);
  }
  for (bool progress = true; progress;) {
    progress = false;
    for (const std::int64_t voxel : waiting) progress = s.fill(voxel) || progress;
    std::erase_if(waiting, [&](std::int64_t voxel) { return s.known[voxel] == s.kAll; });
  }
  for (const std::int64_t voxel : waiting) {
    for (int f = 0; f < kFields; ++f) {
      if ((s.known[voxel] >> f & 1) == 0) s.value[voxel][f] = 0.0f;
    }
  }
  tbb::parallel_for(std::size_t{0}, table.size(), [&](std::size_t n) {
    for (int f = 0; f < kFields; ++f) {
      float* to = leaves[f][n]->buffer().data();
      for (int i = 0; i < kLeafSize; ++i) to[i] = s.value[n * kLeafSize + i][f];
    }
  });
}

template <int kFields>
void extrapolateFields(const std::vector<Extrapolated>& fields, const FloatGrid& phi,
                       const FloatGrid& solidPhi, const Visibility* visibility) {
  const LeafTable table = makeLeafTable(fields[0].field.component[0]->constTree());
  const TableSight sight(table, visibility);
  const std::vector<float> cellPhi = sampleOn(table, phi.constTree());
  std::vector<float> depth = sampleOn(table, solidPhi.constTree());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, depth.size(), kLeafSize), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) depth[i] = -depth[i];
  });
  // One axis a task: each is a long sweep of one thread.
  tbb::parallel_for(
      tbb::blocked_range<int>(0, 3, 1),
      [&](const tbb::blocked_range<int>& range) {
        for (int axis = range.begin(); axis != range.end(); ++axis)
          extrapolateAxis<kFields>(fields, axis, table, sight, cellPhi, depth);
      },
      tbb::simple_partitioner());
}

}  // namespace

void extrapolate(const std::vector<Extrapolated>& fields, const FloatGrid& phi, const FloatGrid& solidPhi,
                 const Visibility* visibility) {
  require(!fields.empty() && fields.size() <= 3, "extrapolate: one to three fields at once");
  if (fields.size() == 1) extrapolateFields<1>(fields, phi, solidPhi, visibility);
  if (fields.size() == 2) extrapolateFields<2>(fields, phi, solidPhi, visibility);
  if (fields.size() == 3) extrapolateFields<3>(fields, phi, solidPhi, visibility);
}

void extrapolate(Velocity& velocity, const FaceMasks& valid, const FloatGrid& phi, const FloatGrid& solidPhi,
                 const Visibility* visibility) {
  extrapolate({{velocity, valid}}, phi, solidPhi, visibility);
}

}  // namespace fluidtex::sim
