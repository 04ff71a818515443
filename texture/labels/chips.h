// Pieces: parts of the surface over which labels continue each other. Chips are those too small to show
// anything of the exemplar: what is left of a piece where others lie over most of it, or what has found no
// more room.
#pragma once

#include "texture/labels/seams.h"

#include <cstdint>

namespace fluidtex::texture {

inline constexpr std::size_t kChip = 25;  // vertices; a piece of fewer is a chip

// Gives chips to the pieces around them: their vertices take what their surroundings continue to, ring by
// ring from the chip's rim, as far as that lies on the exemplar. `free`, #V: only where it is 1 does a label
// change; a chip that is not free throughout stays, and so does one that has nothing around it. Changes
// labels (#V) in place.
void absorbChips(const SeamModel& model, const std::vector<std::uint8_t>& free, Labels& labels);

}  // namespace fluidtex::texture
