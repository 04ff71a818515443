// Colours between the vertices of a textured surface, so that a picture's detail does not end where the
// points' spacing does.
#pragma once

#include "texture/exemplar/exemplar.h"

#include <optional>

namespace fluidtex::texture {

// The exemplar's picture in any resolution, ready to be looked up between vertices.
struct Detail {
  Image color;   // linear RGBA, straight alpha
  Image around;  // lightnessAround(color), over as much of the picture as of the exemplar
  int halvings = 0;
  bool toroidal = false;
  bool seeThrough = false;  // some alpha is below 1
};

// Throws std::invalid_argument if the colours are not RGBA or there are none.
Detail makeDetail(Image color, bool toroidal, int exemplarWidth);

// What the surface shows inside a triangle, at barycentric weights: the picture at the exemplar coordinate
// there, mixed with that at the former place while it fades, as at vertices (shown_color.h). Nothing where
// the corners do not belong to one piece, or the surface has no coordinates: a joint is as wide as a
// triangle, and has its vertices' colours. Straight alpha.
std::optional<Vec4f> colorBetween(const Detail& detail, const TexturedSurface& surface,
                                  std::uint32_t triangle, const Vec3f& weights);

}  // namespace fluidtex::texture
