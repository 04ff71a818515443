// Joints: triangles in which exemplar coordinates cannot be interpolated, since their corners show different
// pieces of texture, and what can be interpolated there instead.
#pragma once

#include "texture/joints/former.h"

#include <array>
#include <cstdint>
#include <optional>

namespace fluidtex::texture {

// Coordinates [label][corner] of a triangle, texels: what the piece of corner `label` has at `corner`. That
// corner's own coordinate where it is of the same piece, else the label's continued by its gradient. Not
// brought back onto the exemplar: around [label][label], the corner's own, there is no jump.
using CornerPlaces = std::array<std::array<Vec2f, 3>, 3>;

struct Joint {
  std::uint32_t triangle = 0;
  CornerPlaces shown;   // of TexturedSurface::coordinate
  CornerPlaces former;  // of Joints::former; where no corner fades, the same as `shown`
};

struct Joints {
  // Triangles whose corners are not all of one piece (places.h), of what is shown or, where a corner fades,
  // of what was shown before; and those of one piece that lie across the edge of a toroidal exemplar, whose
  // labels then are the same. Ascending.
  std::vector<Joint> joints;
  Former former;  // brought onto the exemplar
};

// In a joint, at a point with barycentric coordinates w, there are three places, sum_c w_c places[l][c] for
// each label l, whose look-ups are mixed with the weights w_l. The mixture is the same from both sides of an
// edge. In all other triangles the corners' coordinates, brought onto the exemplar (Torus::brought), are
// interpolated. No joints on a surface without coordinates. Requires gradients.
Joints findJoints(const TexturedSurface& surface, bool toroidal);

// The joint of a triangle; null if it is none.
const Joint* jointIn(const Joints& joints, std::uint32_t triangle);

}  // namespace fluidtex::texture
