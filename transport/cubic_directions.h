// Cubic interpolation of directions between the vertices of a mesh. Linear interpolation once a frame wears a
// field off: after 100 frames of a single vortex on 64 cells it is 9 degrees off, cubic 0.6.
#pragma once

#include "transport/pick_up.h"

namespace fluidtex::transport {

// #V, radians per metre: gradient along the surface of the angle of surface.orientation, counter-clockwise
// seen from outside, up to rotations by 360 / symmetry degrees. Least squares over the one-ring, with the
// fit's own smoothing corrected: fourth order on an even mesh.
std::vector<Vec3f> angleSlopes(const TexturedSurface& surface, int symmetry);

// Direction at a landing point: unit, tangent at landing.normal. The corners' angles against the nearest
// corner's direction, each parallel transported to the landing point's tangent plane, are interpolated by the
// cubic Bezier triangle with their slopes.
Vec3f directionAt(const TexturedSurface& surface, const std::vector<Vec3f>& slopes, const Landing& landing,
                  int symmetry);

}  // namespace fluidtex::transport
