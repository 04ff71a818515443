// The place that fades, as far as it can be interpolated.
#pragma once

#include "texture/joints/places.h"

namespace fluidtex::texture {

// Former exemplar coordinates at every vertex.
struct Former {
  Places places;
  std::vector<std::uint8_t> known;  // #V: 1 where the vertex fades, or one of its neighbours does
};

// A triangle with a corner that fades needs former coordinates at all three. A vertex that does not fade
// takes that of the neighbour with the largest weight (of these the first), continued to it; where no
// neighbour fades, its present coordinate and gradient stand.
Former formerPlaces(const TexturedSurface& surface);

}  // namespace fluidtex::texture
