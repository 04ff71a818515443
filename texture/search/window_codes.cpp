#include "texture/search/window_codes.h"

#include <algorithm>

namespace fluidtex::texture {
namespace {

constexpr float kMost = 32767.0f;
// Margin of the range, since queries may lie slightly outside.
constexpr float kRoom = 1.1f;

std::int16_t codeOf(const WindowCodes& codes, std::size_t k, float value) {
  const float at = (value - codes.low[k]) / codes.step + 0.5f;
  return at > 0.0f ? std::int16_t(std::min(at, kMost)) : std::int16_t(0);  // 0 for NaN
}

}  // namespace

WindowCodes codesFor(std::span<const float> descriptors) {
  std::array<float, kDescriptorSize> least, most;
  std::copy_n(descriptors.begin(), kDescriptorSize, least.begin());
  most = least;
  for (std::size_t i = 0; i < descriptors.size(); ++i) {
    least[i % kDescriptorSize] = std::min(least[i % kDescriptorSize], descriptors[i]);
    most[i % kDescriptorSize] = std::max(most[i % kDescriptorSize], descriptors[i]);
  }
  float range = 1e-6f;
  for (std::size_t k = 0; k < kDescriptorSize; ++k) range = std::max(range, kRoom * (most[k] - least[k]));
  WindowCodes codes;
  codes.step = range / kMost;
  for (std::size_t k = 0; k < kDescriptorSize; ++k) codes.low[k] = 0.5f * (least[k] + most[k] - range);
  return codes;
}

void addCode(WindowCodes& codes, const float* descriptor) {
  for (std::size_t k = 0; k < kDescriptorSize; ++k) codes.fine.push_back(codeOf(codes, k, descriptor[k]));
}

void makeCoarse(WindowCodes& codes) {
  codes.coarse.resize(codes.fine.size());
  for (std::size_t i = 0; i < codes.count(); ++i) {
    const std::int16_t* from = codes.fine.data() + i * kDescriptorSize;
    std::int8_t* to =
        codes.coarse.data() + i / kCodeBlock * kCodeBlock * kDescriptorSize + i % kCodeBlock * 2;
    for (std::size_t k = 0; k < kDescriptorSize; ++k)
      to[k / 2 * 2 * kCodeBlock + k % 2] = std::int8_t(from[k] >> 8);
  }
}

CodedQuery::CodedQuery(const WindowCodes& codes, const float* descriptor) : unit(codes.step * codes.step) {
  for (std::size_t k = 0; k < kDescriptorSize; ++k) {
    fine[k] = codeOf(codes, k, descriptor[k]);
    coarse[k / 2][k % 2] = std::int8_t(fine[k] >> 8);
  }
}

}  // namespace fluidtex::texture
