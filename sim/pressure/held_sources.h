// Sources in liquid that can not take more.
#pragma once

#include "sim/pressure/liquid_cells.h"
#include "sim/solids/solids.h"

#include <vector>

namespace fluidtex::sim {

// The given velocities (SolidField::given), with those slowed that lead into liquid enclosed on all sides: so
// much that no more comes in than goes out. Liquid does not compress; a source in a full room stands still.
// outflow of the cells beside slowed faces is changed with them. Parts that reach a stream side stay as they
// are.
// enclosed: the parts of the liquid without a surface, each a list of its cells.
FaceGrids heldSources(const SolidField& solid, const std::vector<std::vector<int>>& enclosed,
                      LiquidCells& liquid);

}  // namespace fluidtex::sim
