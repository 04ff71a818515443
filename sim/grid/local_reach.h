// How far a flow leads in a step, here and there: most of a liquid is much slower than its fastest jet, and
// what is traced there needs smaller neighbourhoods.
#pragma once

#include "sim/grid/mac_grid.h"

namespace fluidtex::sim {

class LocalReach {
 public:
  // For dt seconds, positive.
  LocalReach(const Velocity& velocity, double dt);

  // At least as far, in cells along each axis, as anything gets that starts in the leaf at `origin`; right
  // where that is no more than a leaf. The leaf need not be one of the velocity's.
  float from(const Coord& origin) const;
  // Of all leaves.
  float farthest() const { return m_farthest; }

 private:
  FloatTree m_blocks;  // one value a leaf, at its origin / 8
  float m_farthest = 0.0f;
};

}  // namespace fluidtex::sim
