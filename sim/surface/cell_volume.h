// Open and liquid volume fractions of cells.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/solids/solids.h"

#include <array>

namespace fluidtex::sim {

using LeafShares = std::array<float, kLeafSize>;

// Volume fraction of each cell of a block that is outside solids, from the solid's distance at the centre. 0
// for cells without an open face, which no liquid can enter.
void openShares(const SolidField& solid, const Coord& origin, LeafShares& open);

// Volume fraction of each cell of a block that is liquid: inside phi's surface and outside solids. Computed
// from the two distances at the centre and the angle between the surface and the solid.
// seen: a cell whose centre is not liquid counts only beside one whose centre is, since elsewhere there is no
// surface (a film thinner than a cell is unresolved); phi is extrapolated to centres in solids, and counts in
// cells that are open towards this one. unseen: it counts everywhere.
enum class Counts { seen, unseen };
void liquidShares(const FloatGrid& phi, const SolidField& solid, const Coord& origin, LeafShares& liquid,
                  Counts counts = Counts::seen);

}  // namespace fluidtex::sim
