// Slips, sub-texel misalignments: edges across which labels continue each other with an error below kCoherent
// texels. Windows are matched at whole texels and lie between them, so that patches that are one in the
// exemplar meet like that everywhere; each slip stretches or compresses the texture on a single edge.
#pragma once

#include "texture/labels/seams.h"

#include <cstdint>

namespace fluidtex::texture {

// Diffuses slips over a few rings of vertices: free vertices (`free` #V; empty: all) move towards the mean of
// the texels that the labels of neighbours they continue predict there; their Jacobians are then refitted.
// Other vertices keep their labels. Wider misalignments stay.
void closeSlips(const SeamModel& model, const std::vector<std::uint8_t>& free, Labels& labels);

}  // namespace fluidtex::texture
