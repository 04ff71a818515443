// New surface needs a start of its own: what was carried onto it is a magnified copy of what is near.
#pragma once

#include "texture/labels.h"
#include "texture/renewal.h"

#include <cstdint>
#include <vector>

namespace fluidtex::texture {

// Lays one block of the exemplar over the members of each of the discs that need it (growth above
// kFreshGrowth, hardly anything to believe, or a guidanceCost() above kFreshGuidance on average): of many
// random places those are looked at that the surface uses least, and of these the one is taken whose texels
// differ least from `value`, the picture that is there. Blocks are as large as discs of `radius`
// (DiscOptions), and go on over members beyond. All other labels stay.
void startAfresh(const MeshView& view, const TexelImage& image, const std::vector<Disc>& discs, double radius,
                 const Values& value, std::uint64_t seed, Labels& labels);
inline constexpr float kFreshGrowth = 1.44f, kFreshGuidance = 0.1f;

}  // namespace fluidtex::texture
