// Several exemplars as one picture, with a guidance map that tells them apart: guidance then decides which of
// them appears where, and what lies between them.
#pragma once

#include "texture/transition/transition.h"

#include <cstdint>
#include <vector>

namespace fluidtex::texture {

// A pixel of one of several pictures.
struct PixelOrigin {
  std::int32_t picture = 0, x = 0, y = 0;
};

struct JoinedExemplars {
  int width = 0, height = 0;
  std::vector<PixelOrigin> source;  // width x height, rows from the top
  // One channel, the level of each pixel: k / (n - 1) in the k-th of n exemplars, rising evenly in the
  // transition to the next.
  Image guidance;
};

// The pictures side by side, each overlapping the next by a transition's width: as high as the lowest, of the
// others the middle. Linear RGBA. Throws std::invalid_argument: fewer than two; what transition() throws; a
// picture narrower than its two transitions.
JoinedExemplars joinExemplars(const std::vector<Image>& pictures, const TransitionOptions& options);

// Maps of the same kind over each exemplar, of its size and with equal channels, joined as the exemplars are.
// Throws std::invalid_argument where they are not.
Image joinedMap(const JoinedExemplars& joined, const std::vector<Image>& maps);

}  // namespace fluidtex::texture
