// Gauss-Seidel sweeps that keep the strains up to date: a face computes its residual from its six samples,
// and updates them at once. Faces of one component and one parity of i + j + k share no sample, so each such
// group is swept in parallel. Coarse levels have the same form with cells twice as large: masses and weights
// are summed, not Galerkin's products. The coarsest level is factored. So are thin parts on the finest: a
// sheet of one or two cells bends almost without strain, in modes that no coarser grid represents.
#include "sim/viscosity/viscous_multigrid.h"

#include "numerics/block_table.h"
#include "sim/viscosity/viscous_factor.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>

namespace fluidtex::sim {

// Interpolation weights between a level's faces and the next coarser one's.
struct FaceTransfer {
  std::vector<std::array<std::int32_t, 8>> parent;  // the coarse level's nowhere() for none
  std::vector<std::array<float, 8>> weight;
};

namespace {

using Range = tbb::blocked_range<std::int32_t>;
constexpr std::int32_t kFacesAtOnce = 4096;
// A level of at most this many faces is factored instead of coarsened.
constexpr std::int32_t kSmall = 1500;
// Coarsening stops where a level would keep more than this share of the faces, as with scattered drops.
constexpr double kMinShrink = 0.7;
// Up to this many faces the coarsest level is factored; beyond, it is swept this often.
constexpr std::int32_t kLargestFactored = 40000;
constexpr int kCoarsestSweeps = 8;
// Below this weight, relative to a full cell's mass, sweeps suffice for thin parts too.
constexpr float kStiff = 5.0f;
// Thin parts of more faces than this are left to the sweeps.
constexpr std::size_t kLargestThin = 200000;

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

int componentOf(const ViscousSystem& system, std::int32_t face) {
  return face < system.start[0].back() ? 0 : (face < system.start[1].back() ? 1 : 2);
}

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

ViscousSystem coarsen(const ViscousSystem& fine, FaceTransfer& transfer) {
  ViscousSystem coarse;
  FloatTree topology(0.0f);
  for (const Coord& origin : fine.table.origins) {
    // Parents lie up to one voxel outside of the block's half.
    for (int corner = 0; corner < 8; ++corner) {
      topology.touchLeaf(Coord((origin[0] >> 1) + ((corner & 1) != 0 ? 4 : -1),
                               (origin[1] >> 1) + ((corner & 2) != 0 ? 4 : -1),
                               (origin[2] >> 1) + ((corner & 4) != 0 ? 4 : -1)));
    }
  }
  coarse.table = makeLeafTable(topology);
  BlockTable leaves(coarse.table.size());
  for (const Coord& origin : coarse.table.origins) leaves.enter(origin);

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

  // Strains: a difference over two cells is twice that over one, so a weight counts a quarter.
  std::array<std::vector<StrainSample>, kStrains> samples;
  tbb::parallel_for(0, kStrains, [&](int t) {
    VoxelFinder finder(leaves);
    std::vector<float> weight(coarse.table.voxels(), 0.0f);
    const int p = kStrainAxes[t][0], q = kStrainAxes[t][1];
    const auto exists = [&](std::int64_t voxel) {
      if (voxel < 0) return false;
      const auto faces = facesOfStrain(coarse, t, voxel);
      return std::all_of(faces.begin(), faces.end(), [](std::int32_t f) { return f >= 0; });
    };
    for (std::int32_t s = fine.typeStart[t]; s < fine.typeStart[t + 1]; ++s) {
      const StrainSample& sample = fine.samples[s];
      const bool free = std::all_of(sample.face.begin(), sample.face.end(),
                                    [&](std::int32_t f) { return f < fine.unknowns || f == fine.nowhere(); });
      if (!free) continue;  // part of the anchors
      const Coord at = fine.coord[sample.face[t < 3 ? 0 : 1]];
      Coord base(at[0] >> 1, at[1] >> 1, at[2] >> 1);
      std::int64_t found[4];
      int count = 0;
      const int ups = t >= 3 && (at[p] & 1) != 0 ? 1 : 0, upt = t >= 3 && (at[q] & 1) != 0 ? 1 : 0;
      for (int dp = 0; dp <= ups; ++dp) {
        for (int dq = 0; dq <= upt; ++dq) {
          Coord place = base;
          place[p] += dp;
          if (t >= 3) place[q] += dq;
          const std::int64_t voxel = finder.at(place);
          if (exists(voxel)) found[count++] = voxel;
        }
      }
      for (int n = 0; n < count; ++n) weight[found[n]] += 0.25f * sample.weight / static_cast<float>(count);
    }
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
  linkSamples(coarse);
  return coarse;
}

}  // namespace

struct ViscousMultigrid::Level {
  ViscousSystem own;            // of coarse levels
  const ViscousSystem& system;  // `own`, or the caller's
  FaceTransfer transfer;        // to the next level
  std::vector<float> inverseDiagonal;
  std::vector<float> x, b;                // faces + 1 values, those that are not unknown 0
  std::vector<float> strain;              // samples + 1 values
  std::vector<float> r;                   // #unknowns
  std::unique_ptr<ViscousFactor> factor;  // of all faces of the coarsest level, of thin parts on the finest

  explicit Level(const ViscousSystem& finest) : system(finest) { prepare(); }
  Level(ViscousSystem&& coarse, int) : own(std::move(coarse)), system(own) { prepare(); }

  void prepare() {
    inverseDiagonal.resize(system.unknowns);
    tbb::parallel_for(Range(0, system.unknowns, kFacesAtOnce), [&](const Range& range) {
      for (std::int32_t i = range.begin(); i < range.end(); ++i) {
        const int c = componentOf(system, i);
        float diagonal = system.mass[i];
        for (int slot = 0; slot < 6; ++slot) {
          const std::int32_t s = system.samplesOf[i][slot];
          if (s == sampleCount()) continue;
          const float q = strainOf(system.samples[s], c, slot);
          diagonal += system.samples[s].weight * q * q;
        }
        inverseDiagonal[i] = 1.0f / diagonal;
      }
    });
    x.assign(system.faces + 1, 0.0f);
    b.assign(system.faces + 1, 0.0f);
    r.assign(system.unknowns, 0.0f);
    strain.assign(system.samples.size() + 1, 0.0f);
  }

  std::int32_t sampleCount() const { return static_cast<std::int32_t>(system.samples.size()); }

  float residual(std::int32_t i, int c) const {
    float rest = b[i] - system.mass[i] * x[i];
    for (int slot = 0; slot < 6; ++slot) {
      const std::int32_t s = system.samplesOf[i][slot];
      if (s == sampleCount()) continue;
      const StrainSample& sample = system.samples[s];
      rest -= sample.weight * strainOf(sample, c, slot) * strain[s];
    }
    return rest;
  }

  void sweepColor(int color) {
    const int c = color >> 1, parity = color & 1;
    const auto& start = system.start[c];
    tbb::parallel_for(std::size_t{0}, system.table.size(), [&](std::size_t n) {
      for (std::int32_t i = start[2 * n + parity]; i < start[2 * n + parity + 1]; ++i) {
        const float change = residual(i, c) * inverseDiagonal[i];
        x[i] += change;
        for (int slot = 0; slot < 6; ++slot) {
          const std::int32_t s = system.samplesOf[i][slot];
          if (s != sampleCount()) strain[s] += strainOf(system.samples[s], c, slot) * change;
        }
      }
    });
  }

  void factorize(std::vector<std::int32_t> faces) {
    factor = std::make_unique<ViscousFactor>(system, std::move(faces));
    if (!factor->good()) factor.reset();
  }

  void updateStrain() {
    tbb::parallel_for(Range(0, sampleCount(), kFacesAtOnce), [&](const Range& range) {
      for (std::int32_t s = range.begin(); s < range.end(); ++s) {
        const StrainSample& sample = system.samples[s];
        strain[s] = sample.a * (x[sample.face[1]] - x[sample.face[0]]) +
                    sample.b * (x[sample.face[3]] - x[sample.face[2]]);
      }
    });
  }

  // Solves for the factored faces while all others stay as they are.
  void solveFactored() {
    const auto& faces = factor->faces();
    std::vector<double> rest(faces.size());
    tbb::parallel_for(std::size_t{0}, faces.size(),
                      [&](std::size_t n) { rest[n] = residual(faces[n], componentOf(system, faces[n])); });
    factor->solve(rest);
    for (std::size_t n = 0; n < faces.size(); ++n) x[faces[n]] += static_cast<float>(rest[n]);
    updateStrain();
  }
};

ViscousMultigrid::ViscousMultigrid(const ViscousSystem& system) {
  m_levels.push_back(std::make_unique<Level>(system));
  while (m_levels.back()->system.unknowns > kSmall) {
    Level& fine = *m_levels.back();
    ViscousSystem coarse = coarsen(fine.system, fine.transfer);
    if (coarse.unknowns > kMinShrink * fine.system.unknowns) break;
    m_levels.push_back(std::make_unique<Level>(std::move(coarse), 0));
  }
  const std::int32_t last = m_levels.back()->system.unknowns;
  if (last <= kLargestFactored) {
    std::vector<std::int32_t> all(last);
    std::iota(all.begin(), all.end(), 0);
    m_levels.back()->factorize(std::move(all));
  }
  if (m_levels.size() == 1 && m_levels.back()->factor) return;
  const auto stiffest =
      std::max_element(system.samples.begin(), system.samples.end(),
                       [](const StrainSample& a, const StrainSample& b) { return a.weight < b.weight; });
  if (stiffest == system.samples.end() || stiffest->weight < kStiff) return;
  std::vector<std::int32_t> thin = facesOfThinParts(system);
  if (!thin.empty() && thin.size() <= kLargestThin) m_levels.front()->factorize(std::move(thin));
}

ViscousMultigrid::~ViscousMultigrid() = default;

void ViscousMultigrid::apply(const std::vector<float>& b, std::vector<float>& x) {
  Level& finest = *m_levels.front();
  std::copy(b.begin(), b.begin() + finest.system.unknowns, finest.b.begin());
  cycle(0);
  std::copy(finest.x.begin(), finest.x.begin() + finest.system.unknowns, x.begin());
}

void ViscousMultigrid::cycle(std::size_t number) {
  Level& level = *m_levels[number];
  const std::int32_t unknowns = level.system.unknowns;
  std::fill(level.x.begin(), level.x.end(), 0.0f);
  std::fill(level.strain.begin(), level.strain.end(), 0.0f);
  if (level.factor && static_cast<std::int32_t>(level.factor->faces().size()) == unknowns) {
    level.solveFactored();
    return;
  }
  const int sweeps = number + 1 == m_levels.size() ? kCoarsestSweeps : 1;
  for (int n = 0; n < sweeps; ++n) {
    for (int color = 0; color < 6; ++color) level.sweepColor(color);
  }
  if (level.factor) level.solveFactored();
  if (number + 1 < m_levels.size()) {
    Level& coarse = *m_levels[number + 1];
    std::fill(coarse.b.begin(), coarse.b.end(), 0.0f);
    tbb::parallel_for(0, 3, [&](int c) {
      for (std::int32_t i = level.system.start[c].front(); i < level.system.start[c].back(); ++i) {
        const float rest = level.residual(i, c);
        // Not at nowhere(), which the three components share.
        for (int n = 0; n < 8; ++n) {
          const std::int32_t parent = level.transfer.parent[i][n];
          if (parent < coarse.system.unknowns) coarse.b[parent] += level.transfer.weight[i][n] * rest;
        }
      }
    });
    cycle(number + 1);
    tbb::parallel_for(Range(0, unknowns, kFacesAtOnce), [&](const Range& range) {
      for (std::int32_t i = range.begin(); i < range.end(); ++i) {
        for (int n = 0; n < 8; ++n)
          level.x[i] += level.transfer.weight[i][n] * coarse.x[level.transfer.parent[i][n]];
      }
    });
    level.updateStrain();
    if (level.factor) level.solveFactored();
  }
  for (int n = 0; n < sweeps; ++n) {
    for (int color = 5; color >= 0; --color) level.sweepColor(color);
  }
}

}  // namespace fluidtex::sim
