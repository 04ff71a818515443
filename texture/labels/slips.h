// Slips: joints at which two pieces of the exemplar are off by less than kCoherent texels. Windows are found
// at whole texels and lie between them, so that pieces that are one in the exemplar meet like that
// everywhere; as each slip is taken up by a single edge, texture is drawn out or squeezed there.
#pragma once

#include "texture/labels/seams.h"

#include <cstdint>

namespace fluidtex::texture {

// Spreads slips over some rings of vertices: free vertices (free empty: all) move towards the mean of what
// the labels of those neighbours that they continue() put there, and their Jacobians are fitted to where
// these neighbours are then. The others keep their labels. Wider joints stay as they are.
void closeSlips(const SeamModel& model, const std::vector<std::uint8_t>& free, Labels& labels);

}  // namespace fluidtex::texture
