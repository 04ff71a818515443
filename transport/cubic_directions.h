// A field of directions between the vertices of a mesh, to higher order. Interpolated linearly once a frame
// it wears off: after 100 frames of a single vortex on 64 cells it is 9 degrees off, cubically 0.6.
#pragma once

#include "transport/pick_up.h"

namespace fluidtex::transport {

// #V, radians per metre: how the angle of surface.orientation grows along the surface, counter-clockwise seen
// from outside, up to turns of 360 / symmetry degrees. Least squares over the ring of neighbours, with the
// smoothing that lies in it taken back: fourth order on an even mesh.
std::vector<Vec3f> angleSlopes(const TexturedSurface& surface, int symmetry);

// The direction at a place: unit, tangent at landing.normal. The corners' angles against the nearest corner's
// direction, each turned into the place's tangent plane, are joined by the cubic Bezier triangle that has
// their slopes.
Vec3f directionAt(const TexturedSurface& surface, const std::vector<Vec3f>& slopes, const Landing& landing,
                  int symmetry);

}  // namespace fluidtex::transport
