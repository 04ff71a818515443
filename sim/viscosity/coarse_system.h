// The next coarser level of a viscous system, of the same form with cells twice as large: masses and weights
// of strains are summed, not Galerkin's products.
#pragma once

#include "sim/viscosity/viscous_system.h"

#include <array>
#include <cstdint>
#include <vector>

namespace fluidtex::sim {

// Interpolation weights, #unknowns of the fine level, between a level's faces and the next coarser one's.
struct FaceTransfer {
  std::vector<std::array<std::int32_t, 8>> parent;  // the coarse level's nowhere() for none
  std::vector<std::array<float, 8>> weight;
};

// Fills `transfer`. Masses of given faces and the drag of walls go to the faces that they tie.
ViscousSystem coarsen(const ViscousSystem& fine, FaceTransfer& transfer);

}  // namespace fluidtex::sim
