// Repetitions in a texture.
#pragma once

#include "texture/measure/tiles.h"

namespace fluidtex::texture {

// Likeness::repeats, on a connected region of at most 40,000 vertices. picture: as from encodedPicture(). The
// exemplar's windows are read at random places through the same vertices.
double repeatsOf(const TileGround& ground, const Image& picture, Dice& dice);

}  // namespace fluidtex::texture
