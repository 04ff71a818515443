// Whether a texture says the same thing twice.
#pragma once

#include "texture/measure/tiles.h"

namespace fluidtex::texture {

// Likeness::repeats, of at most 40,000 vertices that lie together. picture: as of encodedPicture(). The
// exemplar's windows are read at random places through the same vertices.
double repeatsOf(const TileGround& ground, const Image& picture, Dice& dice);

}  // namespace fluidtex::texture
