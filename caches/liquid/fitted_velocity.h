// Motion of a surface that comes without velocities.
#pragma once

#include "sim/grid/mac_grid.h"

#include <openvdb/openvdb.h>

namespace fluidtex::caches {

// Velocity that carries the surface last = 0 to phi = 0 in `seconds`, m/s, at the centres of the cells where
// both level sets (metres, of one transform) are known: u that minimises the sum of
// (dphi/dt + u . grad phi)^2 over some three cells around each cell (Lucas and Kanade 1981, of distances in
// place of brightness), phi being the mean of both. On a flat surface only the motion across it is known, and
// u is along the normal; where the surface bends within these cells, as on drops and crests, u is the motion
// of its shape. Motion of more than the band's five cells is not seen.
sim::FaceGrids fittedVelocity(const openvdb::FloatGrid& last, const openvdb::FloatGrid& phi, double seconds);

}  // namespace fluidtex::caches
