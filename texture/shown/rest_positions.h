// Textures by rest positions, as other programs carry them, for comparison.
#pragma once

#include "texture/exemplar/image.h"
#include "texture/surface.h"

namespace fluidtex::texture {

struct RestOptions {
  bool toroidal = false;  // else the exemplar is repeated mirrored
  // Frames between resets of a rest; 0: one rest that is never reset, the position at birth (UVW).
  int every = 0;
};

// An oriented surface whose colours are projected from rest positions: the exemplar, one texel per spacing,
// lies in the planes x = 0, y = 0 and z = 0, and its three look-ups are mixed by the fourth power of the
// normal's components. Rest positions are transported with the surface; where it has just come to light (of
// low trust) they are its own. With `every` frames there are two rests, each reset to the present positions
// after 2 `every` frames, in turn, and cross-faded so that one weighs nothing when it is reset (dual rest
// fields, as Houdini's liquids have them). frame: numbered from 1. Coordinates and gradients are 0; age is
// that of the surface.
TexturedSurface restTextured(Surface surface, const Carried& carried, const Image& color,
                             const RestOptions& options, int frame, double secondsSinceLast);

}  // namespace fluidtex::texture
