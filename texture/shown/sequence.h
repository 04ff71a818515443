// Exemplars that move: sequences of pictures, looked up as one picture is.
#pragma once

#include "texture/exemplar/image.h"
#include "texture/options.h"
#include "texture/surface.h"

#include <cstddef>
#include <vector>

namespace fluidtex::texture {

// What is shown between two pictures of a sequence: numbers from 0, and the share of the later one, 0..1.
struct ShownPictures {
  std::size_t first = 0, second = 0;
  float share = 0.0f;
};

// Pictures shown `seconds` after the start. count: of pictures. Precondition: count >= 1, seconds >= 0.
ShownPictures picturesAt(const AnimationOptions& animation, std::size_t count, double seconds);

// Pictures shown at a level of guidance, 0 (the first) to 1 (the last), clamped. Precondition: count >= 1.
ShownPictures picturesFor(std::size_t count, float level);

// Linear RGBA of one size, straight alpha, mixed as light; share: of the second. Throws std::invalid_argument
// if they are of different sizes or not RGBA.
Image mixed(const Image& first, const Image& second, float share);

// Sets surface.color as lookUpColor() does (texture/shown/maps.h), each vertex by pictures of its own. shown:
// #V. Throws as lookUpColor(), and std::invalid_argument if the pictures differ in size, or `shown` has not
// #V members or names a picture that is not there.
void lookUpColors(const std::vector<Image>& pictures, const std::vector<ShownPictures>& shown, bool toroidal,
                  TexturedSurface& surface);

}  // namespace fluidtex::texture
