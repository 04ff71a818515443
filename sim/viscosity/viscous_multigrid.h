// A symmetric V-cycle for viscous systems: the preconditioner of solveViscous.
#pragma once

#include "sim/viscosity/viscous_system.h"

#include <memory>
#include <vector>

namespace fluidtex::sim {

class ViscousMultigrid {
 public:
  // Builds the coarse levels. The system must outlive the object.
  explicit ViscousMultigrid(const ViscousSystem& system);
  ~ViscousMultigrid();

  // x = M b with M symmetric, positive definite and an approximate inverse of the system's matrix. #unknowns
  // values each; b of magnitude about 1. Single precision.
  void apply(const std::vector<float>& b, std::vector<float>& x);

 private:
  struct Level;
  void cycle(std::size_t level);

  std::vector<std::unique_ptr<Level>> m_levels;
};

}  // namespace fluidtex::sim
