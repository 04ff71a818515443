// Sources in liquid that cannot take more.
#pragma once

#include "sim/pressure/liquid_cells.h"
#include "sim/solids/solids.h"

#include <vector>

namespace fluidtex::sim {

// The given velocities (SolidField::given), with those slowed that lead into liquid enclosed on all sides: so
// much that no more comes in than goes out. Liquid does not compress; nothing comes out of a source in a full
// room, though the faces within it keep their velocity.
// outflow of the cells beside slowed faces is changed with them. Parts that reach a stream side stay as they
// are.
// enclosed: the parts of the liquid without a surface, each a list of its cells.
FaceGrids slowedSources(const SolidField& solid, const std::vector<std::vector<int>>& enclosed,
                        LiquidCells& liquid);

// What sources take back of such parts while their volume deficit is given back
// (PressureOptions::divergence): a room that fills up may have been given more by then than it holds. Where
// it was given less, more comes in; neither faster than the source gives.
// enclosed: parts of the unknowns; liquidOf: the cell of each unknown. outflow: wanted of each unknown;
// reduced by what leaves through the source's faces. velocity: at these faces, set.
void takeBack(const SolidField& solid, const std::vector<std::vector<int>>& enclosed,
              const std::vector<int>& liquidOf, const LiquidCells& liquid, std::vector<double>& outflow,
              FaceGrids& velocity);

}  // namespace fluidtex::sim
