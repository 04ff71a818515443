// Alpha expansion [Boykov01, Kwatra03]: labels grow over discs of their surroundings along minimal cuts, so
// that fragments that the optimisation leaves become whole patches.
#pragma once

#include "texture/labels/seams.h"

#include <cstdint>

namespace fluidtex::texture {

// Visits discs of the surface. Offers each the labels of its centre and of vertices around it, continued over
// the disc by parallel transport. A graph cut finds exactly which vertices take the label: the minimum of
// their unary costs (`terms`) and of the seam costs of their edges (seamCost). A cut is taken only if it
// lowers the sum by more than a threshold, so the sum never rises.
// Usage is that of the texels at the time of the cut. Vertices outside `free` (#V; empty: all are free) keep
// their labels. Discs that do not touch are cut in parallel. Returns the share of cuts taken.
double expandLabels(const SeamModel& model, const LabelTerms& terms, const std::vector<std::uint8_t>& free,
                    std::uint64_t seed, Labels& labels);

}  // namespace fluidtex::texture
