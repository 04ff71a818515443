// Colours inside the triangles of a textured surface, so that detail does not end at the spacing of the
// points.
#pragma once

#include "texture/exemplar/exemplar.h"
#include "texture/joints/joints.h"

#include <optional>

namespace fluidtex::texture {

// The exemplar's picture in any resolution, prepared for look-up.
struct Detail {
  Image color;   // linear RGBA, straight alpha
  Image around;  // lightnessAround(color), over as much of the picture as of the exemplar
  int halvings = 0;
  bool toroidal = false;
  bool seeThrough = false;  // some alpha is below 1
};

// Throws std::invalid_argument if the colours are not RGBA or there are none.
Detail makeDetail(Image color, bool toroidal, int exemplarWidth);

// Colour at barycentric weights in a triangle, straight alpha: the picture at the interpolated exemplar
// coordinate, cross-faded with the former coordinate as at vertices (shown_color.h). In joints the look-ups
// of the three labels are mixed. joints: findJoints() of the surface. Nothing where the surface has no
// coordinates.
std::optional<Vec4f> colorBetween(const Detail& detail, const TexturedSurface& surface, const Joints& joints,
                                  std::uint32_t triangle, const Vec3f& weights);

}  // namespace fluidtex::texture
