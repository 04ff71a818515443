// Conversion between volume deficit and surface, in single cells.
#pragma once

#include "sim/flows/flows.h"
#include "sim/grid/grids.h"
#include "sim/markers/markers.h"
#include "sim/solids/solids.h"

namespace fluidtex::sim {

// Turns a deficit that fills a cell back into surface. A level set alone loses films and drops thinner than
// its cells; their volume is deficit where they were (see sim/volume/volume_deficit.h). Where the flow
// gathers so much of it in an air cell that the cell is almost full, with no liquid beside it that could take
// it (a source's own cannot), phi becomes a surface there again. Its distance from the centre is that of a
// plane that cuts off this volume. The deficit is reduced by what the surface then encloses, so that the sum
// stays. Air markers in and beside these cells are dropped, or they would remove the surface.
void regainSurface(FloatGrid& phi, Markers& markers, FloatGrid& deficit, const SolidField& solid,
                   const RunningFlows& flows = {});

// The reverse. Markers can hold a speck of surface in a film or thread that has become much thinner than a
// cell. Where the fluxes have left almost nothing in a cell inside such a surface, it is removed. The sum
// stays.
void withdrawSurface(FloatGrid& phi, Markers& markers, FloatGrid& deficit, const SolidField& solid);

}  // namespace fluidtex::sim
