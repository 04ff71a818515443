#include "sim/viscosity/viscous_factor.h"

#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>

#include <tbb/parallel_for.h>

namespace fluidtex::sim {

struct ViscousFactor::Matrix {
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> factor;
};

ViscousFactor::ViscousFactor(const ViscousSystem& system, std::vector<std::int32_t> faces)
    : m_faces(std::move(faces)), m_matrix(std::make_unique<Matrix>()) {
  std::vector<std::int32_t> place(system.faces + 1, -1);
  for (std::size_t n = 0; n < m_faces.size(); ++n) place[m_faces[n]] = static_cast<std::int32_t>(n);
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t n = 0; n < m_faces.size(); ++n)
    entries.emplace_back(static_cast<int>(n), static_cast<int>(n), system.mass[m_faces[n]]);
  for (const StrainSample& sample : system.samples) {
    const double q[4] = {-sample.a, sample.a, -sample.b, sample.b};
    for (int k = 0; k < 4; ++k) {
      const std::int32_t row = place[sample.face[k]];
      if (row < 0) continue;
      for (int l = 0; l < 4; ++l) {
        const std::int32_t column = place[sample.face[l]];
        if (column >= 0 && column <= row) entries.emplace_back(row, column, sample.weight * q[k] * q[l]);
      }
    }
  }
  const auto size = static_cast<Eigen::Index>(m_faces.size());
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  m_matrix->factor.compute(matrix);
}

ViscousFactor::~ViscousFactor() = default;

bool ViscousFactor::good() const {
  return m_matrix->factor.info() == Eigen::Success;
}

void ViscousFactor::solve(std::vector<double>& b) const {
  const Eigen::Map<const Eigen::VectorXd> right(b.data(), static_cast<Eigen::Index>(b.size()));
  const Eigen::VectorXd solved = m_matrix->factor.solve(right);
  std::copy(solved.begin(), solved.end(), b.begin());
}

std::vector<std::int32_t> facesOfThinParts(const ViscousSystem& system) {
  const LeafTable& table = system.table;
  using Cells = std::vector<std::uint8_t>;
  const auto forAll = [&](const auto& body) {
    tbb::parallel_for(std::size_t{0}, table.size(), [&](std::size_t n) {
      for (std::size_t v = n * kLeafSize; v < (n + 1) * kLeafSize; ++v) body(static_cast<std::int64_t>(v));
    });
  };
  // Dilates the cells with the value `which` by one in all 26 directions, one axis after the other.
  const auto spread = [&](Cells& cells, std::uint8_t which) {
    for (int axis = 0; axis < 3; ++axis) {
      Cells next = cells;
      forAll([&](std::int64_t v) {
        for (int side = 2 * axis; side < 2 * axis + 2; ++side) {
          const std::int64_t beside = table.neighbor(v, side);
          if ((beside < 0 ? 0 : cells[beside]) == which) next[v] = which;
        }
      });
      cells.swap(next);
    }
  };
  const auto faceAt = [&](std::int64_t v, int side) {
    const std::int64_t at = (side & 1) != 0 ? table.neighbor(v, side) : v;
    return at < 0 ? -1 : system.number[side >> 1][at];
  };
  Cells full(table.voxels());
  forAll([&](std::int64_t v) {
    full[v] = 1;
    for (int side = 0; side < 6; ++side) full[v] &= faceAt(v, side) >= 0;
  });
  Cells thick = full;
  spread(thick, 0);
  spread(thick, 1);
  Cells thin(table.voxels());
  forAll([&](std::int64_t v) { thin[v] = full[v] != 0 && thick[v] == 0; });
  spread(thin, 1);
  spread(thin, 1);

  std::vector<std::uint8_t> chosen(system.unknowns, 0);
  std::vector<std::int32_t> faces;
  for (std::size_t v = 0; v < table.voxels(); ++v) {
    if (thin[v] == 0) continue;
    for (int side = 0; side < 6; ++side) {
      const std::int32_t f = faceAt(static_cast<std::int64_t>(v), side);
      if (f >= 0 && f < system.unknowns) chosen[f] = 1;
    }
  }
  for (std::int32_t f = 0; f < system.unknowns; ++f) {
    if (chosen[f] != 0) faces.push_back(f);
  }
  return faces;
}

}  // namespace fluidtex::sim
