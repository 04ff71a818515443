// Pieces: parts of the surface over which labels continue each other. Chips are those too small to show
// anything of the exemplar: what is left of a piece where others have been laid over most of it.
#pragma once

#include "texture/seams.h"

#include <cstdint>
#include <vector>

namespace fluidtex::texture {

inline constexpr std::size_t kChip = 25;  // vertices; a piece of fewer is a chip

// Gives chips to the pieces around them: their vertices take what their surroundings continue to, ring by
// ring from the chip's rim. Only `free` vertices (#V) change; a chip that is not free throughout stays, and
// so does one that has nothing around it. Sets `changed` (#V) where a label did.
void absorbChips(const SeamModel& model, const std::vector<std::uint8_t>& free, Labels& labels,
                 std::vector<std::uint8_t>& changed);

}  // namespace fluidtex::texture
