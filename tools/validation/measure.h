// How far a level set is from the shape it should have.
#pragma once

#include "sim/grid/mac_grid.h"
#include "tools/validation/case.h"
#include "tools/validation/shapes.h"

namespace fluidtex::validation {

struct ShapeError {
  double volume = 0.0;      // of the liquid, m3, as phi interpolated trilinearly has it
  double difference = 0.0;  // volume that is in one of liquid and exact shape, but not in both, m3
  double farthest = 0.0;    // of the surface's crossings of grid lines from the exact shape, metres
};

// Of phi against the exact shape over the box between the centres of the cells `first` and `cells` - 1. Cubes
// between cell centres that the surface of either cuts are split into samples^3 parts.
ShapeError compare(const sim::FloatGrid& phi, const Distance& exact, const sim::Coord& cells,
                   const sim::Coord& samples, const sim::Coord& first = sim::Coord(0));

// The outline phi = 0 in the plane of the cells with this k, as pairs of points (x, y), metres.
std::vector<std::array<double, 2>> outline(const sim::FloatGrid& phi, const sim::Coord& cells, int k);

}  // namespace fluidtex::validation
