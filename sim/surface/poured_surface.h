// Where a body of liquid that is poured has a surface of its own.
#pragma once

#include "sim/shapes/shape_distance.h"

#include <functional>

namespace fluidtex::sim {

// Distance at world positions to the surface of a body of liquid, as unite() takes it: metres, negative
// inside. A body ends at solids, within a twentieth of a cell of them or anywhere in them, without a surface
// there: near a corner between wall and surface its own distance would be that to the wall, and cells there
// would say that the surface lies too low. There it is the distance to where the surface crosses the axes,
// exact for a plane that crosses each within two cells; farther from the surface it is at least 1.8 cells. A
// surface that a solid cuts goes on into the solid. solids: their distance, that of the domain's sides among
// them. h: the cells' size.
std::function<double(const Vec3d&)> pouredSurface(const ShapeDistance& body,
                                                  std::function<double(const Vec3d&)> solids, double h);

}  // namespace fluidtex::sim
