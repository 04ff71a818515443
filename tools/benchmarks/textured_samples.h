// What the benchmarks of synthesis and output are made from: an exemplar of any size, and surfaces to put it
// on.
#pragma once

#include "scenes/scene.h"
#include "texture/exemplar/exemplar.h"
#include "texture/surface.h"

namespace fluidtex::benchmarks {

// Green scales of so many pixels' width, toroidal, each scale of the same size in pixels, as nearly as whole
// pairs of rows are; linear RGBA. size: a multiple of 16.
texture::Image scales(int size);

// An oriented sphere of about so many points, with so many levels.
texture::Surface sphere(int points, int levels);

// A level sheet that is drawn out evenly, as in scenes/flows/stretch.toml, on as many cells as points along a
// side.
scenes::Scene stretchedSheet(int points);

}  // namespace fluidtex::benchmarks
