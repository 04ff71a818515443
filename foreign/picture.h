// A picture of any kind, as a file of others holds it.
#pragma once

#include "foreign/ask.h"

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>

namespace fluidtex::foreign {

inline constexpr int kLargestSide = 16384;  // pixels
// 2^26 pixels: one gigabyte as linear RGBA, and as much again for each thing made from it.
inline constexpr std::int64_t kLargestArea = std::int64_t(1) << 26;

enum class Sample : std::int32_t { byte, word, real };  // 0..255, 0..65535, float
enum class Curve : std::int32_t { linear, srgb, power };

struct PictureHead {
  std::int32_t width = 0, height = 0;  // as stored: before the orientation is applied
  std::int32_t channels = 0;           // 1: grey, 2: grey and alpha, 3: RGB or XYZ, 4: RGBA
  Sample sample = Sample::real;
  Curve curve = Curve::linear;   // from stored to linear values of colours
  float exponent = 1.0f;         // of Curve::power
  std::int32_t orientation = 1;  // of TIFF and EXIF, 1..8
  std::int32_t straight = 1;     // colours are not multiplied by alpha
  // Of heights: the largest number of the stored type, which is read as 1 (of floats 1), and the number that
  // stands for none, as it is stored.
  double white = 1.0, noData = 0.0;
  std::int32_t hasNoData = 0;
};

struct Picture : PictureHead {
  std::string samples;  // rows from the top as they are stored, height x width x channels

  std::size_t sampleSize() const { return sample == Sample::byte ? 1 : sample == Sample::word ? 2 : 4; }
};

// A sample as it is stored at that place, whole numbers as shares of their white.
inline float shareAt(const char* from, Sample sample) {
  if (sample == Sample::byte) return float(static_cast<unsigned char>(*from)) * (1.0f / 255.0f);
  if (sample == Sample::real) {
    float value;
    std::memcpy(&value, from, sizeof value);
    return value;
  }
  std::uint16_t value;
  std::memcpy(&value, from, sizeof value);
  return float(value) * (1.0f / 65535.0f);
}

// The primaries of sRGB: what an embedded profile, or an EXR's chromaticities, say otherwise is converted.
// Of several parts or layers the one named RGB, RGBA, beauty or Combined (or the only one) is taken, of an
// EXR what lies inside its display window. Throws Unreadable.
Picture readColors(const std::filesystem::path& file);

// The same as the numbers that are stored; normals named X, Y, Z and a lone channel of any name are taken
// too. Throws Unreadable.
Picture readNumbers(const std::filesystem::path& file);

// The first channel alone as the numbers that are stored, not multiplied by alpha, of pictures of up to
// kLargestSide squared pixels, and what GDAL says in a TIFF of pixels without data. Inks come mixed, in three
// channels. Throws Unreadable.
Picture readHeights(const std::filesystem::path& file);

// What readColors() cannot do for the file's colours, as the end of a sentence that begins with its name;
// empty if there is nothing to say. Looks at the beginning of the file only. Throws Unreadable.
std::string colorNote(const std::filesystem::path& file);

}  // namespace fluidtex::foreign
