// Chips: patches (regions over which labels continue each other) too small to show anything of the exemplar.
// They remain where newer patches cover most of an older one, or find no more room.
#pragma once

#include "texture/labels/seams.h"

#include <cstdint>

namespace fluidtex::texture {

inline constexpr std::size_t kChip = 25;  // vertices; a smaller patch is a chip

// Absorbs chips into the patches around them: from the rim inwards, ring by ring, each vertex takes the
// continuation of a neighbour's label, as far as that lies on the exemplar. Chips with a vertex that is not
// `free` (#V, 1: may change) stay, and so do chips without surroundings. Changes labels (#V) in place.
void absorbChips(const SeamModel& model, const std::vector<std::uint8_t>& free, Labels& labels);

}  // namespace fluidtex::texture
