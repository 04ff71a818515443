// How far a flow moves anything in a step, by place: most of a liquid is much slower than its fastest jet,
// and traces there need smaller neighbourhoods.
#pragma once

#include "sim/grid/mac_grid.h"

namespace fluidtex::sim {

class LocalReach {
 public:
  // For dt seconds, positive.
  LocalReach(const Velocity& velocity, double dt);

  // Upper bound, in cells along each axis, of the distance that anything moves that starts in the leaf at
  // `origin`; valid where that is no more than a leaf. The leaf need not be one of the velocity's.
  float from(const Coord& origin) const;
  // The largest of all leaves.
  float farthest() const { return m_farthest; }

 private:
  FloatTree m_blocks;  // one value a leaf, at its origin / 8
  float m_farthest = 0.0f;
};

}  // namespace fluidtex::sim
