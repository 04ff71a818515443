// How far a carried value is believed, 0 to 1: a product of what speaks against it.
#pragma once

#include "texture/surface.h"
#include "transport/backtrace.h"
#include "transport/pick_up.h"

namespace fluidtex::transport {

// The place is off the old surface, or on another side of it: exp(-(distance / scale)^2) times a factor that
// falls from 1 to 0 as the angle between the carried normal and the old surface's grows from 60 to 90
// degrees. Surface that the velocity does not explain is found by this, and surface that is new.
float landingTrust(const Landing& landing, double scale, const Vec3f& carriedNormal);

// The texture was deformed since it was laid: 1 up to a stretch of 2, 2 / stretch beyond, but not below 0.6:
// what is stretched is held less, and still is no new surface. The stretch is max(s1, 1 / s2), s1 >= s2 being
// the singular values of the carried gradient, which was 1 / spacing when the texture was laid and has
// gathered every deformation since.
float stretchTrust(const TexelGradient& gradient, double spacing);

// How far the landing places of neighbours differ from what the flow's map says of the edge between them,
// largest over each vertex's edges, as a trust: 1 up to half an edge's length and spacing, 0 from one and a
// half. Low along seams where surfaces from far apart have merged, and where surface was laid open so that
// many vertices land in one place.
std::vector<float> neighborTrust(const texture::SurfaceMesh& mesh, const std::vector<Vec3f>& landed,
                                 const std::vector<Mat3d>& map);

}  // namespace fluidtex::transport
