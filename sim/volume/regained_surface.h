// Liquid that the surface had lost and that is a surface again; and surface where no liquid is left.
#pragma once

#include "sim/grid/grids.h"
#include "sim/markers/markers.h"
#include "sim/solids/solids.h"

namespace fluidtex::sim {

// A level set alone loses films and drops thinner than its cells; they are owed where they were (see
// sim/volume/volume_deficit.h). Where the flow gathers so much of that in a cell of the air that it is all
// but full, with no liquid beside it that could take it, phi becomes a surface there again, as far from the
// centre as a plane that parts so much from the cell. What it then holds is owed no more: the sum stays.
// Markers of the air in and beside these cells are dropped, or they would take the surface away.
void regainSurface(FloatGrid& phi, Markers& markers, FloatGrid& deficit, const SolidField& solid);

// The other way round: where the flow has left next to nothing in a cell that phi still shows, by a speck of
// a surface that markers hold in a film or thread long thinner than a cell, there is none any more. The sum
// stays.
void withdrawSurface(FloatGrid& phi, Markers& markers, FloatGrid& deficit, const SolidField& solid);

}  // namespace fluidtex::sim
