#include "sim/viscosity/coarse_system.h"

#include "numerics/block_table.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace fluidtex::sim {
namespace {

// A face's place among coarse ones: along its own axis on one of them or between two, along the others a
// quarter of a coarse cell away.
struct Parents {
  Coord coord[8];
  float weight[8];
  bool needed[8];  // whether it exists for this face; others are used where they exist
  int count = 0;
};

Parents parentsOf(const Coord& face, int c) {
  Parents parents;
  const int s = (c + 1) % 3, t = (c + 2) % 3;
  const bool between = (face[c] & 1) != 0;
  for (int up = 0; up <= (between ? 1 : 0); ++up) {
    for (int ds = 0; ds < 2; ++ds) {
      for (int dt = 0; dt < 2; ++dt) {
        const int n = parents.count++;
        Coord& at = parents.coord[n];
        at[c] = (face[c] >> 1) + up;
        at[s] = (face[s] >> 1) + (ds != 0 ? ((face[s] & 1) != 0 ? 1 : -1) : 0);
        at[t] = (face[t] >> 1) + (dt != 0 ? ((face[t] & 1) != 0 ? 1 : -1) : 0);
        parents.weight[n] = (between ? 0.5f : 1.0f) * (ds != 0 ? 0.25f : 0.75f) * (dt != 0 ? 0.25f : 0.75f);
        parents.needed[n] = ds == 0 && dt == 0;
      }
    }
  }
  return parents;
}

// Voxels of a table by coordinate.
class VoxelFinder {
 public:
  explicit VoxelFinder(const BlockTable& leaves) : m_leaves(leaves) {}

  std::int64_t at(const Coord& c) const {
    const Coord origin = c & ~(kLeafDim - 1);
    const std::uint32_t leaf = m_leaves.find(origin);
    if (leaf == BlockTable::kNone) return -1;
    return static_cast<std::int64_t>(leaf) * kLeafSize + ((c[0] & 7) << 6) + ((c[1] & 7) << 3) + (c[2] & 7);
  }

 private:
  const BlockTable& m_leaves;
};

// Masses plus the drag of walls: what ties a face to values that are 0 in a correction.
std::vector<float> anchors(const ViscousSystem& system) {
  std::vector<float> anchor = system.mass;
  for (const StrainSample& sample : system.samples) {
    for (int k = 0; k < 4; ++k) {
      const std::int32_t own = sample.face[k], other = sample.face[k ^ 1];
      if (own >= system.unknowns || other < system.unknowns || other == system.nowhere()) continue;
      const float q = k < 2 ? sample.a : sample.b;
      anchor[own] += sample.weight * q * q;
    }
  }
  return anchor;
}

// Leaves of the next coarser level. Parents lie up to one voxel outside of a block's half.
LeafTable coarseLeaves(const LeafTable& fine) {
  FloatTree topology(0.0f);
  for (const Coord& origin : fine.origins) {
    for (int corner = 0; corner < 8; ++corner) {
      topology.touchLeaf(Coord((origin[0] >> 1) + ((corner & 1) != 0 ? 4 : -1),
                               (origin[1] >> 1) + ((corner & 2) != 0 ? 4 : -1),
                               (origin[2] >> 1) + ((corner & 4) != 0 ? 4 : -1)));
    }
  }
  return makeLeafTable(topology);
}

// Numbers the coarse faces that a fine one needs as a parent.
void numberParents(const ViscousSystem& fine, const BlockTable& leaves, ViscousSystem& coarse) {
  std::array<std::vector<std::uint8_t>, 3> state;
  tbb::parallel_for(0, 3, [&](int c) {
    VoxelFinder finder(leaves);
    state[c].assign(coarse.table.voxels(), 0);
    for (std::int32_t f = fine.start[c].front(); f < fine.start[c].back(); ++f) {
      const Parents parents = parentsOf(fine.coord[f], c);
      for (int n = 0; n < parents.count; ++n) {
        if (parents.needed[n]) state[c][finder.at(parents.coord[n])] = 1;
      }
    }
  });
  numberFaces(coarse, state);
}

// Parents and weights of the fine faces, and the masses of the coarse ones.
FaceTransfer linkParents(const ViscousSystem& fine, const BlockTable& leaves, ViscousSystem& coarse) {
  FaceTransfer transfer;
  transfer.parent.resize(fine.unknowns);
  transfer.weight.resize(fine.unknowns);
  coarse.mass.assign(coarse.unknowns, 0.0f);
  const std::vector<float> anchor = anchors(fine);
  tbb::parallel_for(0, 3, [&](int c) {
    VoxelFinder finder(leaves);
    for (std::int32_t f = fine.start[c].front(); f < fine.start[c].back(); ++f) {
      const Parents parents = parentsOf(fine.coord[f], c);
      auto& parent = transfer.parent[f];
      auto& weight = transfer.weight[f];
      parent.fill(coarse.nowhere());
      weight.fill(0.0f);
      float sum = 0.0f;
      for (int n = 0; n < parents.count; ++n) {
        const std::int64_t voxel = finder.at(parents.coord[n]);
        if (voxel < 0 || coarse.number[c][voxel] < 0) continue;
        parent[n] = coarse.number[c][voxel];
        weight[n] = parents.weight[n];
        sum += weight[n];
      }
      for (int n = 0; n < 8; ++n) {
        weight[n] /= sum;
        if (weight[n] > 0.0f) coarse.mass[parent[n]] += weight[n] * anchor[f];
      }
    }
  });
  return transfer;
}

// Places of the coarse samples of a strain around a fine one: two along each axis on which it lies between
// two.
struct CoarsePlaces {
  Coord at[4];
  int count = 0;
};

// t: type of the strain. at: the fine sample's face.
CoarsePlaces coarsePlaces(const Coord& at, int t) {
  const int p = kStrainAxes[t][0], q = kStrainAxes[t][1];
  const int upP = t >= 3 && (at[p] & 1) != 0 ? 1 : 0, upQ = t >= 3 && (at[q] & 1) != 0 ? 1 : 0;
  CoarsePlaces places;
  for (int dp = 0; dp <= upP; ++dp) {
    for (int dq = 0; dq <= upQ; ++dq) {
      Coord place(at[0] >> 1, at[1] >> 1, at[2] >> 1);
      place[p] += dp;
      if (t >= 3) place[q] += dq;
      places.at[places.count++] = place;
    }
  }
  return places;
}

// #voxels of the coarse table: summed weights of strain `t`. A difference over two cells is twice that over
// one, so a weight counts a quarter. Samples at given faces are part of the anchors.
std::vector<float> coarseWeights(const ViscousSystem& fine, const ViscousSystem& coarse,
                                 const BlockTable& leaves, int t) {
  VoxelFinder finder(leaves);
  std::vector<float> weight(coarse.table.voxels(), 0.0f);
  const auto exists = [&](std::int64_t voxel) {
    if (voxel < 0) return false;
    const auto faces = facesOfStrain(coarse, t, voxel);
    return std::all_of(faces.begin(), faces.end(), [](std::int32_t f) { return f >= 0; });
  };
  for (std::int32_t s = fine.typeStart[t]; s < fine.typeStart[t + 1]; ++s) {
    const StrainSample& sample = fine.samples[s];
    const bool free = std::all_of(sample.face.begin(), sample.face.end(),
                                  [&](std::int32_t f) { return f < fine.unknowns || f == fine.nowhere(); });
    if (!free) continue;
    std::int64_t found[4];
    int count = 0;
    const CoarsePlaces places = coarsePlaces(fine.coord[sample.face[t < 3 ? 0 : 1]], t);
    for (int n = 0; n < places.count; ++n) {
      const std::int64_t voxel = finder.at(places.at[n]);
      if (exists(voxel)) found[count++] = voxel;
    }
    for (int n = 0; n < count; ++n) weight[found[n]] += 0.25f * sample.weight / static_cast<float>(count);
  }
  return weight;
}

// Fills samples and typeStart.
void sumStrains(const ViscousSystem& fine, const BlockTable& leaves, ViscousSystem& coarse) {
  std::array<std::vector<StrainSample>, kStrains> samples;
  tbb::parallel_for(0, kStrains, [&](int t) {
    const std::vector<float> weight = coarseWeights(fine, coarse, leaves, t);
    for (std::size_t v = 0; v < weight.size(); ++v) {
      if (weight[v] <= 0.0f) continue;
      StrainSample sample;
      sample.face = facesOfStrain(coarse, t, static_cast<std::int64_t>(v));
      sample.weight = weight[v];
      if (t < 3) sample.b = 0.0f;
      samples[t].push_back(sample);
    }
  });
  for (int t = 0; t < kStrains; ++t) {
    coarse.typeStart[t] = static_cast<std::int32_t>(coarse.samples.size());
    coarse.samples.insert(coarse.samples.end(), samples[t].begin(), samples[t].end());
  }
  coarse.typeStart[kStrains] = static_cast<std::int32_t>(coarse.samples.size());
}

}  // namespace

ViscousSystem coarsen(const ViscousSystem& fine, FaceTransfer& transfer) {
  ViscousSystem coarse;
  coarse.table = coarseLeaves(fine.table);
  BlockTable leaves(coarse.table.size());
  for (const Coord& origin : coarse.table.origins) leaves.enter(origin);
  numberParents(fine, leaves, coarse);
  transfer = linkParents(fine, leaves, coarse);
  sumStrains(fine, leaves, coarse);
  linkSamples(coarse);
  return coarse;
}

}  // namespace fluidtex::sim
