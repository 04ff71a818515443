// How much room, and how much liquid, there is in each cell.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/solids/solids.h"

#include <array>

namespace fluidtex::sim {

using LeafShares = std::array<float, kLeafSize>;

// The share of each cell of a block that no solid takes, from the solid's distance at the centre; 0 for cells
// without an open face, which nothing can get into.
void openShares(const SolidField& solid, const Coord& origin, LeafShares& open);

// The share of each cell of a block that is liquid: what phi's surface encloses outside solids, from the
// distances at the centre and the angle between the surface and the solid. A cell whose centre is not liquid
// counts only beside one whose centre is: else there is no surface, and nobody sees it; or everywhere.
enum class Counts { seen, unseen };
void liquidShares(const FloatGrid& phi, const SolidField& solid, const Coord& origin, LeafShares& liquid,
                  Counts counts = Counts::seen);

}  // namespace fluidtex::sim
