// Volume fraction of a cell on one side of a plane.
#pragma once

namespace fluidtex::sim {

// Share of a cube, 0 to 1, where a linear field is negative. middle: its value at the cube's centre. gx, gy,
// gz: its change over one side of the cube along each axis. Within 1e-4: slopes below that share of their sum
// count as so much. Source: Scardovelli and Zaleski, "Analytical relations connecting linear interfaces and
// volume fractions in rectangular grids", 2000.
double negativeShare(double middle, double gx, double gy, double gz);

}  // namespace fluidtex::sim
