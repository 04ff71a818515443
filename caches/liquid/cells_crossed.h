// What a level set of a surface would take.
#pragma once

#include "caches/liquid/surface_mesh.h"

namespace fluidtex::caches {

// The cells of side h (metres) that the surface crosses, and how far from the origin it reaches, metres.
struct CellsCrossed {
  double cells = 0.0, farthest = 0.0;
  // A stray vertex, or cells in another unit, must not take all memory: at 170 bytes each, 3e7 cells are 5
  // GB. Farther than 4e6 cells from the origin, single precision does not tell places within a cell apart.
  bool fits(double h) const { return cells <= 3e7 && farthest <= 4e6 * h; }
};
CellsCrossed cellsCrossed(const SurfaceTriangles& surface, double h);

}  // namespace fluidtex::caches
