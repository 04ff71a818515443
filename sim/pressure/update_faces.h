// What the pressure does to the velocity: the last part of a projection. q: pressure of the cells, #cells, in
// the unit in which a face's velocity changes by the difference of q across it, m/s.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/pressure/liquid_cells.h"
#include "sim/pressure/tension_pressure.h"
#include "sim/solids/solids.h"

#include <vector>

namespace fluidtex::sim {

// Outflow through a cell's open faces after the pressure has acted, m/s through one face.
double projectedOutflow(const LiquidCells& liquid, const SurfacePressure& surface,
                        const std::vector<double>& q, int number);

// Subtracts the pressure gradient on the faces of `grid`, which are normal to `axis`, sets closed ones to the
// solid's speed (or, beside a cell that is `detached` (#cells), to that at which liquid leaves it), and
// writes given velocities. Returns the valid faces.
MaskGrid::Ptr updateFaces(const LiquidCells& liquid, const SurfacePressure& surface, const SolidField& solid,
                          const std::vector<double>& q, const std::vector<char>& detached, int axis,
                          FloatGrid& grid);

// Liquid cells that separate, active. A cell deep in a solid has almost no open area: the liquid beside it
// separates with it.
MaskGrid::Ptr separatingCells(const LiquidCells& liquid, const SolidField& solid,
                              const std::vector<char>& detached);

}  // namespace fluidtex::sim
