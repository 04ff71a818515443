// Repetitions in a texture.
#pragma once

#include "texture/measure/tiles.h"

namespace fluidtex::texture {

// Likeness::repeats, over the windows at the first 40,000 vertices in breadth-first order, component by
// component. picture: as from encodedPicture(). The exemplar's windows are read at random places through the
// same vertices. 0 if no window is complete.
double repeatsOf(const TileGround& ground, const Image& picture, Dice& dice);

}  // namespace fluidtex::texture
