// Visibility of cells beside solids, and what stands behind thin ones for stencils.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/grid/visibility.h"

#include <limits>
#include <memory>

namespace fluidtex::sim {

// Extrapolates a stencil of a level set linearly along the axes, from visible cells to hidden ones, so that
// the surface continues behind the wall. An extrapolated value keeps the sign of the value beside it, except
// where it rises from liquid to air by more than `gap` (in the unit of the values) per cell: there liquid
// separates from a wall along which its surface lies.
void extrapolateBehind(Stencil& values, const VisibleCells& visible,
                       float gap = std::numeric_limits<float>::infinity());

// The same for a surface that lies on the wall itself and leaves it: values rise by `step` with each cell
// along the axes that the wall blocks.
void riseBehind(Stencil& values, const VisibleCells& visible, float step);

// Visibility from solidPhi and open, as in SolidField. Null where all is visible.
// Of two cells outside solids, one is visible from the other where a path leads there that turns back along
// no axis and passes through open faces only. Cells deeper in the solid than kDeepInSolid, whose values are
// extrapolated from the nearest cell outside, count as that cell.
std::shared_ptr<const Visibility> visibilityOf(const FloatGrid& solidPhi, const FaceGrids& open);

}  // namespace fluidtex::sim
