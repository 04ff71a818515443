// What the numbers of a picture mean as light, by the ICC profile in its file.
#pragma once

#include "foreign/unreadable.h"

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace fluidtex::foreign {

class ColorProfile {
 public:
  // Of pictures with 1 (grey), 3 (RGB) or 4 (CMYK) channels. Throws Unreadable (what is wrong with the
  // profile) where it is damaged, or is for other channels.
  ColorProfile(std::span<const unsigned char> icc, int channels);

  // RGB of other primaries (x and y of red, green, blue and white), linear or encoded as sRGB is.
  ColorProfile(std::span<const float, 8> chromaticities, bool isEncoded);

  // Whether it says no more than that the picture is sRGB-encoded; to 3/4 of one of 255 levels.
  bool isSrgb() const { return m_srgb; }

  // Linear sRGB, 3 a pixel, of `pixels` times so many channels of 0..1 (inks: 1 is full); may leave 0..1
  // where the profile holds more colours than sRGB.
  void toLinear(const float* in, std::size_t pixels, float* out) const;

 private:
  void become(void* profile);
  void findCurves();
  void convert(const float* in, std::size_t pixels, float* out) const;

  int m_channels = 3;
  bool m_srgb = false;
  std::shared_ptr<void> m_transform;
  // Screens' profiles are a curve for each channel and a matrix: found from the transform itself, and used
  // where they do the same as it does, since that is ten times as fast. Else empty.
  std::vector<float> m_curve[3];
  float m_matrix[3][3] = {};
};

// The channels that an ICC profile is for: 1, 3 or 4; 0 for any others. By its header alone.
int profileChannels(std::span<const unsigned char> icc);

}  // namespace fluidtex::foreign
