// The paper's transport: coordinates and directions as fields on the simulation's grid [Kwatra07 sec. VI].
#pragma once

#include "transport/backtrace.h"
#include "transport/band.h"

#include <functional>

namespace fluidtex::transport {

// Origin of each position by equation (3): x, y and z at the cells' centres are scalars, advected by
// first-order upwind differences through all substeps and interpolated at the positions; their gradient is
// the map. First order in cell and step, with the numerical diffusion of upwind schemes. A position beyond
// the band stays where it is, with known = 0.
Backtrace traceOnGrid(const std::vector<Vec3f>& positions, const sim::Frame& frame);

// Directions by equation (4), d_t = -(u . grad) d + (I - d d^T)(d . grad) u; its first term alone if
// `turning` is false. extended(x): direction off the surface at the start of the frame, constant along the
// normals; evaluated as far from the old surface's points `surface` as the flow reaches in the frame. Returns
// one vector per position, not normalised; 0 beyond that.
std::vector<Vec3f> directionsOnGrid(const std::vector<Vec3f>& positions, const sim::Frame& frame,
                                    const std::vector<Vec3f>& surface,
                                    const std::function<Vec3d(const Vec3d&)>& extended, bool turning);

}  // namespace fluidtex::transport
