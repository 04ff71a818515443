// Quantised descriptors. Distances are first computed from the upper seven bits of each component, for
// sixteen windows at once, then from all fifteen bits for the few that are near.
#pragma once

#include "numerics/lanes.h"
#include "texture/search/pca.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace fluidtex::texture {

inline constexpr std::size_t kCodeBlock = 16;

struct WindowCodes {
  // Component k is low[k] + step * fine. One step for all components, so that distances keep their
  // proportions.
  std::array<float, kDescriptorSize> low{};
  float step = 1.0f;
  std::vector<std::int16_t> fine;  // #n x kDescriptorSize, 0 .. 32767
  // fine >> 8 in blocks of kCodeBlock windows; pairs of components are adjacent, then windows, then pairs.
  // Empty until makeCoarse().
  std::vector<std::int8_t> coarse;
  std::size_t count() const { return fine.size() / kDescriptorSize; }
};

// The quantisation of descriptors (#n x kDescriptorSize), without codes yet.
WindowCodes codesFor(std::span<const float> descriptors);

// Adds a descriptor, clamped to the range.
void addCode(WindowCodes& codes, const float* descriptor);

// Fills codes.coarse from codes.fine. Precondition: their count is a multiple of kCodeBlock.
void makeCoarse(WindowCodes& codes);

// A quantised query.
struct CodedQuery {
  CodedQuery(const WindowCodes& codes, const float* descriptor);
  std::array<std::int16_t, kDescriptorSize> fine;
  std::array<std::array<std::int8_t, 2>, kDescriptorSize / 2> coarse;
  float unit;  // step squared
};

// Squared distances of a block's windows from the upper bits, in squared coarse steps, saturated at 32767.
inline Short16 coarseDistances(const WindowCodes& codes, std::size_t block, const CodedQuery& query) {
  const std::int8_t* at = codes.coarse.data() + block * kCodeBlock * kDescriptorSize;
#ifdef __AVX2__
  __m256i sum[2] = {_mm256_setzero_si256(), _mm256_setzero_si256()};
  for (std::size_t pair = 0; pair < query.coarse.size(); ++pair, at += 2 * kCodeBlock) {
    std::int16_t both;
    std::memcpy(&both, query.coarse[pair].data(), sizeof both);
    const __m256i values = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(at));
    const __m256i difference = _mm256_abs_epi8(_mm256_sub_epi8(values, _mm256_set1_epi16(both)));
    sum[pair % 2] = _mm256_adds_epi16(sum[pair % 2], _mm256_maddubs_epi16(difference, difference));
  }
  return Short16(_mm256_adds_epi16(sum[0], sum[1]));
#else
  std::array<int, kCodeBlock> sum{};
  for (const std::array<std::int8_t, 2>& pair : query.coarse)
    for (int& own : sum)
      for (const std::int8_t value : pair) {
        const int difference = *at++ - value;
        own += difference * difference;
      }
  Short16 result;
  for (std::size_t i = 0; i < kCodeBlock; ++i) result[i] = std::int16_t(sum[i] < 32767 ? sum[i] : 32767);
  return result;
#endif
}

// Squared distance of one window, in units of the descriptors.
inline float fineDistance(const WindowCodes& codes, std::size_t window, const CodedQuery& query) {
  const std::int16_t* at = codes.fine.data() + window * kDescriptorSize;
  Float8 sum{};
  for (std::size_t k = 0; k < kDescriptorSize; k += 8) {
    Float8 difference;
    for (std::size_t i = 0; i < 8; ++i) difference[i] = float(at[k + i] - query.fine[k + i]);
    sum += difference * difference;
  }
  return query.unit * sum8(sum);
}

}  // namespace fluidtex::texture
