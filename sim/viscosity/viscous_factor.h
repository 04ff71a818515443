// Direct solves for parts of a viscous system.
#pragma once

#include "sim/viscosity/viscous_system.h"

#include <memory>
#include <vector>

namespace fluidtex::sim {

// Sparse Cholesky factorization of the rows and columns of a viscous system that belong to some faces.
class ViscousFactor {
 public:
  // faces: increasing indices of unknowns.
  ViscousFactor(const ViscousSystem& system, std::vector<std::int32_t> faces);
  ~ViscousFactor();

  const std::vector<std::int32_t>& faces() const { return m_faces; }
  bool good() const;  // false where the matrix is singular to rounding

  // Replaces b, one value a face, by the solution with all other faces at 0.
  void solve(std::vector<double>& b) const;

 private:
  struct Matrix;
  std::vector<std::int32_t> m_faces;
  std::unique_ptr<Matrix> m_matrix;
};

// The unknowns of parts in which no 3 x 3 x 3 cells of liquid fit, and of two cells around them: sheets,
// threads and drops that coarser grids do not resolve.
std::vector<std::int32_t> facesOfThinParts(const ViscousSystem& system);

}  // namespace fluidtex::sim
