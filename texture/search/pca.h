// Principal components of an image's windows: short descriptors whose distances approximate those of windows.
#pragma once

#include "texture/exemplar/exemplar.h"

#include <cstdint>
#include <span>
#include <vector>

namespace fluidtex::texture {

inline constexpr int kDescriptorSize = 24;

// Windows are vectors of length n = window^2 x channels, each pixel scaled by the square root of its weight.
// There the basis is orthonormal, so the distance of two descriptors never exceeds the weighted distance of
// their windows.
struct WindowBasis {
  int size = 0;                  // n
  std::vector<float> component;  // n x kDescriptorSize, row-major, scaled by the root of the weight
  std::vector<float> offset;     // kDescriptorSize: projection of the mean window
  std::vector<float> mean;       // n, the mean window, plain pixel values
};

// The first kDescriptorSize principal components of the image's windows, by randomised subspace iteration on
// a sample of them [Halko, Martinsson, Tropp 2011]. `image`: already padded where it is toroidal, so that
// windows lie inside it. weight: window^2. Components beyond the rank of the windows are zero.
WindowBasis windowBasis(const Image& image, int window, std::span<const float> weight, std::uint64_t seed);

// descriptor = component^T pixels - offset. pixels: n, descriptor: kDescriptorSize.
void describeWindow(const WindowBasis& basis, std::span<const float> pixels, std::span<float> descriptor);

// The window that a descriptor stands for: mean + sum of components. weight as in windowBasis().
void reconstructWindow(const WindowBasis& basis, std::span<const float> weight,
                       std::span<const float> descriptor, std::span<float> pixels);

// Descriptors of all windows whose top left pixels are (i, j) * stride: rows x columns x kDescriptorSize,
// row-major.
std::vector<float> describeAll(const WindowBasis& basis, const Image& image, int window, int stride,
                               int columns, int rows);

}  // namespace fluidtex::texture
