// Extrapolation of phi into solids, and beyond symmetry sides.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/solids/solid_layers.h"
#include "sim/solids/solids.h"

#include <functional>

namespace fluidtex::sim {

// Where more than this share of phi's slope is normal to the wall, the surface runs along the wall: there is
// a gap or a film, and not a surface that the wall cuts.
inline constexpr float kAlongWall = 0.55f;

// Rules for a gap between the surface and a solid that it runs along. Both are asked of cells outside solids,
// beside the solid.
struct GapRules {
  // Whether the gap opens: the liquid has separated from the solid or, where the cell is air, moves away from
  // it.
  std::function<bool(const Coord&)> opens;
  // Otherwise, whether it closes: the liquid moves or is driven against the solid. If neither, the gap keeps
  // its width, as between a pool and a ceiling.
  std::function<bool(const Coord&)> closes;
};

// Extrapolates phi linearly, with its whole gradient, to cells more than half a cell deep in solids, in the
// leaves that phi has. The surface then continues straight into the solid. Exceptions:
// - Where the surface is nearly parallel to the solid and the gap between them closes, the gradient's part
// along the solid's normal is left out. Nothing else would close the last half cell, where the velocity is
// the solid's.
// - It is left out too where a film thinner than half a cell would form that flows out of the solid.
// - Where the gap opens, phi rises along the normal.
// Without rules no gap opens or closes: a gap or film that is there is kept, and none forms.
// deep: depth in the solid from which cells get values, in voxels. visibility: of the solids; nothing is
// extrapolated through a thin one. left: the solids before they moved, null where they did not. Cells that
// they have left take their values from neighbours outside solids, and are air where there are none.
void extendIntoSolids(FloatGrid& phi, const FloatGrid& solidPhi, const GapRules& rules = {},
                      float deep = kDeepInSolid, const Visibility* visibility = nullptr,
                      const FloatGrid* left = nullptr);

// The same for solids and sides of the domain. Beyond symmetry sides phi is its own mirror image.
void extendBeyond(FloatGrid& phi, const SolidField& solid, const GapRules& rules = {},
                  float deep = kDeepInSolid, const FloatGrid* left = nullptr);

}  // namespace fluidtex::sim
