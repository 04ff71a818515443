// What the benchmarks of synthesis are made from: an exemplar of any size, and a surface to put it on.
#pragma once

#include "texture/exemplar/exemplar.h"
#include "texture/surface.h"

namespace fluidtex::benchmarks {

// Green scales of so many pixels' width, toroidal, each scale of the same size in pixels; linear RGBA.
texture::Image scales(int size);

// An oriented sphere of about so many points, with so many levels.
texture::Surface sphere(int points, int levels);

}  // namespace fluidtex::benchmarks
