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

// A pixel of one of several pictures.
struct PixelOrigin {
  std::int32_t picture = 0, x = 0, y = 0;
};

// The transition from the last `width` columns of `left` to the first ones of `right`: width x height pixels,
// rows from the top, picture 0 for left and 1 for right. The first column is that of `left` and the last that
// of `right`. Along a row the share of `right` rises from 0 to 1, evenly as a mean over seeds: features stay
// whole where that costs less than a wrong share. Of all ways to lay the pieces' outlines the one with the
// least visible seams is sought, and pieces are moved in their texture until they fit: alpha expansion with
// offsets as labels. The same on any number of threads. Pictures: linear RGBA, of one height. Throws
// std::invalid_argument: other pictures; a width below 8 or wider than either of them; a feature below 2
// pixels.
std::vector<PixelOrigin> transition(const Image& left, const Image& right, const TransitionOptions& options);

}  // namespace fluidtex::texture
