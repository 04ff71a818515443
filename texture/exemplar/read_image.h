// Reads image files, as linear RGBA or as numbers.
#pragma once

#include "foreign/picture.h"
#include "texture/exemplar/exemplar.h"

#include <filesystem>

namespace fluidtex::texture {

using foreign::kLargestSide;

// Reads an image as linear RGBA with sRGB primaries and straight alpha, rows from the top. Grey becomes R = G
// = B, CMYK is converted, alpha is 1 where a file has none, and the file's orientation is applied. Integers
// are taken as sRGB-encoded, floats as linear, unless the file or its colour profile says otherwise. Of a
// layered file the visible layer is read (foreign/picture.h).
// Throws ExemplarError: missing, not an image, a side above kLargestSide, values that are not finite, errors
// of the reading library.
Image readImage(const std::filesystem::path& file);

// Reads a map (height, roughness, guidance) as stored, integers as 0..1: one channel of a grey image, three
// of a coloured one; only the first with `channels` 1. Throws as readImage().
Image readMap(const std::filesystem::path& file, int channels = 0);

}  // namespace fluidtex::texture
