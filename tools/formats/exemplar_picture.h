// The exemplar and its maps as PNG files, such as those in the run's folder that materials look up.
#pragma once

#include "texture/exemplar/image.h"

#include <string>

namespace fluidtex::tools {

// In the folder of the run: the exemplar, and the picture that `texture.between_file` names.
inline constexpr const char *kExemplarFile = "exemplar.png", *kBetweenFile = "between.png";

// In the folder of a run whose exemplar moves with time: the picture that a frame shows.
inline constexpr const char* kMovingExemplar = "exemplar";
std::string exemplarFile(int frame);

// A PNG of 8 bits a channel, sRGB, of linear RGBA pixels with straight alpha. Without alpha where it is 1
// everywhere. Throws std::runtime_error.
std::string pngOf(const texture::Image& color);

// A PNG of 16 bits a channel of numbers 0 to 1 in one or three channels, stored as they are. Throws
// std::runtime_error.
std::string pngOfNumbers(const texture::Image& map);

// Whether any alpha is below 1.
bool isSeeThrough(const texture::Image& color);

}  // namespace fluidtex::tools
