// Trust: confidence in a transported value, 0 to 1, as a product of factors.
#pragma once

#include "texture/surface.h"
#include "transport/backtrace.h"
#include "transport/pick_up.h"

namespace fluidtex::transport {

// Distance and side: exp(-(distance / scale)^2) times a factor that falls from 1 to 0 as the angle between
// the carried normal and the old surface's grows from 60 to 90 degrees. Low on new surface, and on motion
// that the velocity does not explain. scale: metres.
float landingTrust(const Landing& landing, double scale, const Vec3f& carriedNormal);

// Stretch since the texture was laid: 1 up to a stretch of 2, 2 / stretch beyond, at least 0.6, since
// stretched texture is held less but is no new surface. Stretch is max(s1, 1 / s2), s1 >= s2 the singular
// values of the transported gradient times `spacing` (metres).
float stretchTrust(const TexelGradient& gradient, double spacing);

// #V, consistency with neighbours. For each edge: deviation of the difference of its ends' landing points
// `landed`
// (#V, metres) from the edge as the flow's map (#V) transforms it, in units of the largest of spacing, edge
// length and transformed length. The largest deviation over a vertex's edges counts: trust is 1 up to 0.5,
// falls linearly and is 0 from 1.5 on. Low along seams where surfaces from far apart have merged, and where
// surface was newly exposed, so that many vertices land in one place. Edges between a vertex that stays (#V,
// 1 where the flow goes through the surface) and one that does not are left out.
std::vector<float> neighborTrust(const texture::SurfaceMesh& mesh, const std::vector<Vec3f>& landed,
                                 const std::vector<Mat3d>& map, const std::vector<std::uint8_t>& stays);

}  // namespace fluidtex::transport
