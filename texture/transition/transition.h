// A transition from one texture to another, by graph cuts [Kwatra03]: every pixel is one of either texture,
// none is a blend. Pieces of the second appear in the first, grow together, and leave pieces of the first.
#pragma once

#include "texture/exemplar/image.h"

#include <cstdint>
#include <vector>

namespace fluidtex::texture {

struct TransitionOptions {
  int width = 160;   // pixels, from the one texture alone to the other alone
  int feature = 24;  // pixels, diameter of the smallest pieces, about that of the textures' features
  std::uint64_t seed = 1;
};

// The transition from the last `width` columns of `left` to the first ones of `right`, lying on each other:
// width x height values, rows from the top, 1 where `right` is shown. The first column is `left`'s and the
// last `right`'s. Along a row the share of `right` rises from 0 to 1, evenly as a mean over seeds: features
// stay whole where that costs less than a wrong share. Of all ways to lay the pieces' outlines it is the one
// with the least visible seams, found by one minimum cut. The same on any number of threads. Pictures: linear
// RGBA, of one height. Throws std::invalid_argument: other pictures; a width below 8 or wider than either of
// them; a feature below 2 pixels.
std::vector<std::uint8_t> transition(const Image& left, const Image& right, const TransitionOptions& options);

}  // namespace fluidtex::texture
