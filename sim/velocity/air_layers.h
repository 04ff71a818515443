// Velocity in the first layers beyond the surface.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/solids/solids.h"

namespace fluidtex::sim {

// Makes the first two layers of air cells divergence-free by changing the faces that lie farther from the
// liquid. The velocity that moves the surface there then conserves volume, as the liquid's own velocity does.
// A velocity that is constant along the surface's normal does not: a wave is slowed by half a cell of it, a
// spreading jet gains volume.
// Faces of `valid` and those of solids keep their values. In each of two sweeps over a layer no component
// becomes larger than one and a half times the largest around its cell, so that air squeezed out between two
// bodies of liquid does not become too fast.
// velocity: extrapolated, m/s. phi, solidPhi: metres. visibility: as in SolidField; thin walls are tight.
// Source: the conditions for faces at the surface of Harlow and Welch, 1965.
void balanceAirLayers(Velocity& velocity, const FaceMasks& valid, const FloatGrid& phi,
                      const FloatGrid& solidPhi, const Visibility* visibility = nullptr);

// Extrapolates face values linearly beyond the surface: two layers of faces that touch no liquid continue
// those that do, each from the two before it in line; where no two lie in line, the mean of the neighbours.
// For interpolation between faces on both sides of the surface, which constant values would bias: a rotating
// disc loses a twentieth of its spin in a turn instead of a quarter. From face to face values change by at
// most a fifth: without this bound a jet off an edge becomes unstable.
// values: at faces, extrapolated. phi: metres. visibility: as in SolidField; nothing is extrapolated through
// a thin wall.
void extendLinearly(Velocity& values, const FloatGrid& phi, const Visibility* visibility = nullptr);

}  // namespace fluidtex::sim
