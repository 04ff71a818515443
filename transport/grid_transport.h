// The paper's own transport: coordinates and directions as fields on the simulation's grid [Kwatra07 sec.
// VI].
#pragma once

#include "transport/backtrace.h"
#include "transport/band.h"

#include <functional>

namespace fluidtex::transport {

// Where each position was at the start of the frame, by equation (3): x, y and z at the cells' centres are
// scalars that the flow carries, by first-order upwind differences through all substeps; interpolated at the
// positions they are the origin, and their slope is the map. First order in cell and step, and blurred like
// every upwind solution. A position beyond the band stays where it is, and known is 0.
Backtrace traceOnGrid(const std::vector<Vec3f>& positions, const sim::Frame& frame);

// Directions by equation (4), d_t = -(u . grad) d + (I - d d^T)(d . grad) u, or, with turning false, by its
// first term alone. extended(x): the direction off the surface at the start of the frame, constant along the
// normals; it is asked for as far from `surface`, the old one's points, as the flow reaches in the frame.
// Gives one vector a position, not normalised; 0 beyond that.
std::vector<Vec3f> directionsOnGrid(const std::vector<Vec3f>& positions, const sim::Frame& frame,
                                    const std::vector<Vec3f>& surface,
                                    const std::function<Vec3d(const Vec3d&)>& extended, bool turning);

}  // namespace fluidtex::transport
