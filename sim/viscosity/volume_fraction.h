// How much of a cell a surface cuts off.
#pragma once

namespace fluidtex::sim {

// Share of a cube, 0 to 1, where a linear field is negative: `middle` is its value at the cube's centre, gx,
// gy, gz how much it changes over one side of the cube along each axis. Scardovelli and Zaleski, "Analytical
// relations connecting linear interfaces and volume fractions in rectangular grids", 2000.
double negativeShare(double middle, double gx, double gy, double gz);

}  // namespace fluidtex::sim
