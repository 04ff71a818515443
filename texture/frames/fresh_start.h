// Initial values of regions to be renewed. Starting from the transported texture would not do: it is
// stretched, and windows matched to it by least difference lose contrast with every renewal.
#pragma once

#include "texture/frames/renewal.h"
#include "texture/labels/labels.h"

#include <cstdint>
#include <vector>

namespace fluidtex::texture {

// Lays one block of the exemplar over each disc. Among random places, the least used are compared; the chosen
// one fits guidance best and correlates most with `value` (#V), the present picture. Blocks have the size of
// discs of nominal `radius` (DiscOptions, pixels) and may lie in any of the exemplar's symmetry variants.
// Members beyond the block continue it. Changes the labels (#V) of disc members only.
void startAfresh(const MeshView& view, const TexelImage& image, const std::vector<Disc>& discs, double radius,
                 const Values& value, std::uint64_t seed, Labels& labels);

}  // namespace fluidtex::texture
