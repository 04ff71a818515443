// What is renewed gets a start of its own: what was carried there is drawn out, and what is found from that,
// by least differences, has less contrast with every renewal.
#pragma once

#include "texture/frames/renewal.h"
#include "texture/labels/labels.h"

#include <cstdint>
#include <vector>

namespace fluidtex::texture {

// Lays one block of the exemplar over the members of each disc: of many random places those are looked at
// that the surface uses least, and of these the one is taken that fits guidance and correlates most with
// `value`, the picture that is there. Blocks are as large as discs of `radius` (DiscOptions), and lie
// in any of the exemplar's ways; members beyond take what the nearest block goes on with. All other labels
// stay.
void startAfresh(const MeshView& view, const TexelImage& image, const std::vector<Disc>& discs, double radius,
                 const Values& value, std::uint64_t seed, Labels& labels);

}  // namespace fluidtex::texture
