// SIMD types for inner loops, those of the compiler: they add, multiply and compare lane by lane, and v[k] is
// lane k. What has no operator (shuffles, minima) is taken from the processor's intrinsics, whose __m128 and
// __m256 are the same types. What stands here compiles to slower code without such registers.
#pragma once

#include <cstdint>
#include <cstring>

#ifdef __AVX__
#include <immintrin.h>
#endif

namespace fluidtex {

using Float4 = float __attribute__((vector_size(16)));
using Float8 = float __attribute__((vector_size(32)));

inline Float4 float4(float x, float y, float z, float w = 0.0f) {
  return Float4{x, y, z, w};
}
inline Float4 float4(float all) {
  return Float4{all, all, all, all};
}
inline Float8 float8(float all) {
  return Float8{all, all, all, all, all, all, all, all};
}

// Two fours side by side, and each of them.
inline Float8 joined8(const Float4& low, const Float4& high) {
  return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
}
inline Float4 low4(const Float8& lanes) {
  return __builtin_shufflevector(lanes, lanes, 0, 1, 2, 3);
}
inline Float4 high4(const Float8& lanes) {
  return __builtin_shufflevector(lanes, lanes, 4, 5, 6, 7);
}

// Eight halves, 11 significant bits: in 0..1 at least eight times as fine as 8-bit colours.
using Half8 = _Float16 __attribute__((vector_size(16)));

inline Float8 widened(const Half8& lanes) {
#ifdef __F16C__
  return Float8(_mm256_cvtph_ps(__m128i(lanes)));
#else
  return __builtin_convertvector(lanes, Float8);
#endif
}

inline Half8 narrowed(const Float8& lanes) {
#ifdef __F16C__
  return Half8(_mm256_cvtps_ph(__m256(lanes), _MM_FROUND_TO_NEAREST_INT));
#else
  return __builtin_convertvector(lanes, Half8);
#endif
}

inline Float4 load4(const float* from) {
  Float4 lanes;
  std::memcpy(&lanes, from, sizeof lanes);
  return lanes;
}

inline void store4(float* to, const Float4& lanes) {
  std::memcpy(to, &lanes, sizeof lanes);
}

inline Float8 load8(const float* from) {
  Float8 lanes;
  std::memcpy(&lanes, from, sizeof lanes);
  return lanes;
}

inline void store8(float* to, const Float8& lanes) {
  std::memcpy(to, &lanes, sizeof lanes);
}

inline float sum8(const Float8& v) {
  return ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7]));
}

// Lane k of `set` where bit k is set, else of `clear`.
inline Float8 select8(unsigned bits, const Float8& set, const Float8& clear) {
  using Int8 = int __attribute__((vector_size(32)));
  constexpr Int8 kBit{1, 2, 4, 8, 16, 32, 64, 128};
  return (kBit & int(bits)) != 0 ? set : clear;
}

// Bit k is set where lane k is at most `bound`.
inline unsigned atMost8(const Float8& v, float bound) {
#ifdef __AVX__
  return unsigned(_mm256_movemask_ps(_mm256_cmp_ps(__m256(v), _mm256_set1_ps(bound), _CMP_LE_OQ)));
#else
  unsigned bits = 0;
  for (unsigned k = 0; k < 8; ++k) bits |= unsigned(v[k] <= bound) << k;
  return bits;
#endif
}

// Bit k is set where lane k is less than `bound`.
inline unsigned below8(const Float8& v, float bound) {
#ifdef __AVX__
  return unsigned(_mm256_movemask_ps(_mm256_cmp_ps(__m256(v), _mm256_set1_ps(bound), _CMP_LT_OQ)));
#else
  unsigned bits = 0;
  for (unsigned k = 0; k < 8; ++k) bits |= unsigned(v[k] < bound) << k;
  return bits;
#endif
}

using Short16 = std::int16_t __attribute__((vector_size(32)));

// Bit k is set where lane k is at most `bound`.
inline unsigned atMost16(const Short16& v, std::int16_t bound) {
#ifdef __AVX2__
  const __m256i above = _mm256_cmpgt_epi16(__m256i(v), _mm256_set1_epi16(bound));
  return _pext_u32(~unsigned(_mm256_movemask_epi8(above)), 0x55555555u);
#else
  unsigned bits = 0;
  for (unsigned k = 0; k < 16; ++k) bits |= unsigned(v[k] <= bound) << k;
  return bits;
#endif
}

}  // namespace fluidtex
