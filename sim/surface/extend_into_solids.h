// How the surface goes on behind the solids that it ends at, and beyond sides of symmetry.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/solids/solid_layers.h"
#include "sim/solids/solids.h"

#include <functional>

namespace fluidtex::sim {

// Where a surface runs along a solid with a gap between them: asked of cells in the open beside the solid.
struct GapRules {
  // Whether the gap opens: the liquid has let go of the solid, or, where the cell is air, moves away from it.
  std::function<bool(const Coord&)> opens;
  // Else, whether it closes: the liquid moves or is driven against the solid. Otherwise it stays as wide as
  // it is, as between a pool and a ceiling.
  std::function<bool(const Coord&)> closes;
};

// Gives the cells more than half a cell deep in solids, in the leaves that phi has, values such that the
// surface runs straight on into the solid, with phi's whole gradient. Not with the part along the solid's
// normal where the surface is nearly parallel to the solid and the gap between them closes (nothing else
// would close the last half cell: there the velocity is the solid's), nor where a film thinner than half a
// cell would begin that flows out of the solid. Where the gap opens, phi rises along the normal. Without
// rules everything stays as it is: a gap or a film that is there is kept, and none begins. deep: from how
// deep in a solid on, in voxels. visibility: of the solids; nothing comes through a thin one. left: the
// solids before they moved, null where they did not; cells that they have left get their values from what is
// beside them in the open, and are air where nothing is.
void extendIntoSolids(FloatGrid& phi, const FloatGrid& solidPhi, const GapRules& rules = {},
                      float deep = kDeepInSolid, const Visibility* visibility = nullptr,
                      const FloatGrid* left = nullptr);

// The same for solids and sides of the domain: beyond sides of symmetry phi is its own mirror image.
void extendBeyond(FloatGrid& phi, const SolidField& solid, const GapRules& rules = {},
                  float deep = kDeepInSolid, const FloatGrid* left = nullptr);

}  // namespace fluidtex::sim
