// Gauss-Seidel sweeps that keep the strains up to date: a face computes its residual from its six samples,
// and updates them at once. Faces of one component and one parity of i + j + k share no sample, so each such
// group is swept in parallel. Coarse levels have the same form with cells twice as large: masses and weights
// are summed, not Galerkin's products. The coarsest level is factored. So are thin parts on the finest: a
// sheet of one or two cells bends almost without strain, in modes that no coarser grid represents.
#include "sim/viscosity/viscous_multigrid.h"

#include "sim/viscosity/coarse_system.h"
#include "sim/viscosity/viscous_factor.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>

namespace fluidtex::sim {

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

int componentOf(const ViscousSystem& system, std::int32_t face) {
  return face < system.start[0].back() ? 0 : (face < system.start[1].back() ? 1 : 2);
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
