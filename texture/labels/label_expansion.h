// Label expansion [Boykov01, Kwatra03]: pieces of the exemplar grow over their surroundings along the cuts
// that show least, so that what the optimisation leaves as chips becomes whole pieces.
#pragma once

#include "texture/labels/seams.h"

#include <cstdint>

namespace fluidtex::texture {

// Offers discs of the surface, one after the other, the labels of their centre and of vertices around it,
// each continued over the whole disc by the surface's own parallel transport. Which of the disc's vertices
// take it is the exact minimum, by a cut, of the sum of their own costs (terms) and of the seams on their
// edges (seamCost); a change is made where the sum falls by more than a threshold, so it never rises. Where
// usage counts, it is that of the texels at the time of the cut. Vertices outside `free` (empty: all are
// free) keep their labels. Discs that do not touch are cut at once. Returns the share of the discs' cuts that
// were taken.
double expandLabels(const SeamModel& model, const LabelTerms& terms, const std::vector<std::uint8_t>& free,
                    std::uint64_t seed, Labels& labels);

}  // namespace fluidtex::texture
