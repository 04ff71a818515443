// Reading an image file of any kind into linear RGBA.
#pragma once

#include "texture/exemplar.h"

#include <filesystem>

namespace fluidtex::texture {

inline constexpr int kLargestSide = 16384;  // pixels

// Linear RGBA with straight alpha, rows from the top. Grey becomes R = G = B, CMYK is turned into RGB, a file
// without alpha gets alpha 1, and the file's own orientation is applied. Integer values are sRGB-encoded and
// float values linear, unless the file says otherwise. Throws ExemplarError: missing, not an image, a side
// above kLargestSide, values that are not finite.
Image readImage(const std::filesystem::path& file);

}  // namespace fluidtex::texture
