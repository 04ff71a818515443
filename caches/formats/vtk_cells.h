// Cells of VTK's unstructured grids.
#pragma once

#include "caches/formats/geometry.h"

#include <cstdint>
#include <span>

namespace fluidtex::caches {

// Adds the surface cells (triangle, strip, polygon, pixel, quad), whose corners lie one behind the other;
// vertices and lines are left out. ends: where the corners of each end; kinds: as in vtkCellType.h.
// Throws std::runtime_error where their numbers differ, a corner is no point, or a cell is a solid or curved.
void addCellsOfKinds(std::span<const std::int64_t> corners, std::span<const std::int64_t> ends,
                     std::span<const std::int64_t> kinds, Geometry& geometry);

}  // namespace fluidtex::caches
