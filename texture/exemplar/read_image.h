// Reading an image file of any kind, into linear RGBA or as numbers.
#pragma once

#include "foreign/picture.h"
#include "texture/exemplar/exemplar.h"

#include <filesystem>

namespace fluidtex::texture {

using foreign::kLargestSide;

// Linear RGBA of sRGB's primaries with straight alpha, rows from the top. Grey becomes R = G = B, CMYK is
// turned into RGB, a file without alpha gets alpha 1, and the file's own orientation is applied. Integer
// values are sRGB-encoded and float values linear, unless the file, or a colour profile in it, says
// otherwise; of a file with layers the one that is shown is taken (foreign/picture.h). Throws ExemplarError:
// missing, not an image, a side above kLargestSide, values that are not finite, and what the library that
// reads it says is wrong.
Image readImage(const std::filesystem::path& file);

// The numbers of a map (height, roughness, a guidance map) as they are stored, whole numbers as 0..1: one
// channel of a grey image, three of a coloured one, or with `channels` 1 the first alone. Throws as
// readImage().
Image readMap(const std::filesystem::path& file, int channels = 0);

}  // namespace fluidtex::texture
