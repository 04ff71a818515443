// The surface of a poured body of liquid, without the parts of it that lie on solids.
#pragma once

#include "sim/grid/grids.h"
#include "sim/solids/solids.h"
#include "sim/vec3.h"

#include <functional>

namespace fluidtex::sim {

// Signed distance to the surface of a body of liquid, as unite() takes it: metres, negative inside, at world
// positions.
// A body has no surface where it ends at a solid: within a twentieth of a cell of it, or anywhere inside. In
// the corner between wall and surface the body's own distance would be that to the wall, and cells there
// would put the surface too low. There it is the distance to where the surface crosses the axes, exact for a
// plane that crosses each within two cells; farther from the surface it is at least 1.8 cells. A surface that
// a solid cuts continues into the solid. Nor is there a surface in a joint, where parts of the body touch.
// body: signed distance to it, metres, a lower bound in magnitude inside where parts of it overlap or touch.
// solids: signed distance to them, metres, with the domain's sides. h: cell size, metres.
std::function<double(const Vec3d&)> pouredSurface(std::function<double(const Vec3d&)> body,
                                                  std::function<double(const Vec3d&)> solids, double h);

// Cells in solids, less than a cell deep, whose phi is the distance to a place on the body's surface outside
// solids, which needs no extrapolation: the body ends before the solid, or goes on in it.
// poured: the body's distance at cell centres; phi: of all liquid; body, solids: as above.
MaskGrid beyondOwnSurface(const FloatGrid& poured, const FloatGrid& phi, const FloatGrid& solidPhi,
                          const std::function<double(const Vec3d&)>& body,
                          const std::function<double(const Vec3d&)>& solids);

// Makes air, half a cell from the surface, of partly open cells in thin walls that are hidden from all liquid
// near them, where a body ends in the wall. A slope of phi from the body's end would make liquid of them, on
// the wall's other side. Where the body comes out of the wall, it has a surface there, and they stay. Returns
// the cells.
MaskGrid clearBehindWalls(FloatGrid& phi, const SolidField& solid,
                          const std::function<double(const Vec3d&)>& body,
                          const std::function<double(const Vec3d&)>& solids);

}  // namespace fluidtex::sim
