// A picture in parts, before it is developed: all light, the share of it that matt surfaces scatter, and what
// each pixel shows.
#pragma once

#include "render/vec.h"

#include <vector>

namespace fluidtex::render {

// Light that reaches the camera by way of the first matt surface on its path, linear, and how uncertain it
// is.
struct MattLight {
  std::vector<Vec3f> radiance;   // height x width
  std::vector<float> deviation;  // height x width: estimated standard error of the radiance's luminance
};

// Arrays are height x width, rows from the top, means over a pixel's filter; positions over the paths that
// met a surface.
struct Layers {
  int width = 0, height = 0;
  std::vector<Vec3f> radiance;  // all light, the two below included
  MattLight sun;                // straight from the sun
  MattLight rest;               // from the sky, from emitters and from other surfaces
  std::vector<Vec3f> albedo;    // of the first matt surface; 0 where there is none
  std::vector<Vec3f> normal;    // of that surface, with bumps; shorter than 1 where the pixel sees several
  std::vector<Vec3f> position;  // of that surface, metres
};

}  // namespace fluidtex::render
