// Reading an image file of any kind, into linear RGBA or as numbers.
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

// The numbers of a map (height, roughness, a guidance map) as they are stored, whole numbers as 0..1: one
// channel of a grey image, three of a coloured one, or with `channels` 1 the first alone. Throws as
// readImage().
Image readMap(const std::filesystem::path& file, int channels = 0);

}  // namespace fluidtex::texture
