// A volume deficit as a grid: its total, where it is largest, how it is given back, and how changes of the
// surface other than by flow are added to it (sim/volume/volume_deficit.h).
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/solids/solids.h"
#include "sim/surface/cell_volume.h"

#include <vector>

namespace fluidtex::sim {

// Divergence that gives the deficit back in about `time` seconds: h^3 per second at cell centres, from at
// most half a cell of deficit. Throws std::invalid_argument where time is not positive.
FloatGrid::Ptr targetDivergence(const FloatGrid& deficit, double time);

// Liquid shares of some blocks, for changes of phi other than by flow.
struct ShownLiquid {
  std::vector<Coord> blocks;
  std::vector<LeafShares> shares;
};
// Of the blocks that hold cells active in `where`, and the blocks beside them.
ShownLiquid shownAround(const MaskGrid& where, const FloatGrid& phi, const SolidField& solid);
// Adds the liquid that the surface has lost since `before` to the deficit, or subtracts what it has gained;
// surface and deficit together stay the same.
void addChange(FloatGrid& deficit, const ShownLiquid& before, const FloatGrid& phi, const SolidField& solid);

// Centre of the cell with the largest deficit, by magnitude, in the block with the largest total; metres.
Vec3d placeOfLargest(const FloatGrid& deficit);

// Total deficit, m3; negative where there is too much liquid.
double totalDeficit(const FloatGrid& deficit);

}  // namespace fluidtex::sim
