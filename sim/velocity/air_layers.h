// The velocity just beyond the surface.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/solids/solids.h"

namespace fluidtex::sim {

// Takes the divergence out of the first two layers of air cells, by the faces that lie farther from the
// liquid: what moves the surface there then keeps volume, as the liquid's own velocity does, which a velocity
// that is constant along the surface's normal does not (a wave is slowed by half a cell of it, a jet that
// spreads swells). Faces of `valid` and those of solids stay. In each of two sweeps over a layer no component
// gets larger than one and a half times the largest around its cell, so that air squeezed out between two
// bodies of liquid does not shoot away. velocity: extrapolated, m/s; phi and solidPhi in metres. Source: the
// conditions for faces at the surface of Harlow and Welch, 1965.
void balanceAirLayers(Velocity& velocity, const FaceMasks& valid, const FloatGrid& phi,
                      const FloatGrid& solidPhi);

// Makes face values linear beyond the surface: two layers of faces that touch no liquid go on from those that
// do, each from the one before it and the one behind that; where no two lie in line, with the mean of those
// beside it. For what is interpolated between faces on both sides of the surface and must not be pulled to
// what is constant beyond it: a disc that turns loses a twentieth of its spin in a turn instead of a quarter.
// From face to face they change by at most a fifth: unbounded, a jet off an edge runs away. values: at faces,
// extrapolated; phi in metres.
void extendLinearly(Velocity& values, const FloatGrid& phi);

}  // namespace fluidtex::sim
