// Trilinear interpolation in a block of floats, z fastest: the innermost loops of all traces along the
// velocity. A place has x, y, z in the first three of four lanes; two places side by side in eight, so that
// the latencies of their loads overlap.
#pragma once

#include "numerics/lanes.h"

#include <immintrin.h>

#include <cstddef>

namespace fluidtex::sim {

// The values at the upper (y, z), of the four corners of a cell's face at p: (0,0), (0,1), (1,0), (1,1).
inline Float4 facePoints(const float* p, std::ptrdiff_t dy) {
  const Float4 low = _mm_castpd_ps(_mm_load_sd(reinterpret_cast<const double*>(p)));
  return _mm_loadh_pi(low, reinterpret_cast<const __m64*>(p + dy));
}

// Interpolates between the eight samples whose lowest is p; tx, ty, tz in [0, 1] from the lowest to the
// highest.
inline float trilinear(const float* p, std::ptrdiff_t dx, std::ptrdiff_t dy, float tx, float ty, float tz) {
  const Float4 low = facePoints(p, dy), high = facePoints(p + dx, dy);
  const Float4 face = low + tx * (high - low);
  const Float4 edge = face + ty * (_mm_movehl_ps(face, face) - face);
  const float from = edge[0];
  return from + tz * (edge[1] - from);
}

// Three blocks of one shape, whose samples lie half a cell lower than those of the first along x, y and z
// each: the components of a velocity on a staggered grid.
struct StaggeredBlocks {
  const float* component[3];
  std::ptrdiff_t side;  // samples along each axis

  // Values at each of two places `centred`, in cells from the first cell centre (the sample u(i, j, k) is at
  // (i - 1/2, j, k)); all samples needed must be there. The two results are independent.
  [[gnu::always_inline]] Float8 at(Float8 centred) const {
    const Float8 shifted = centred + 0.5f;
    const __m256i cell = _mm256_cvttps_epi32(centred), face = _mm256_cvttps_epi32(shifted);
    const Float8 t = centred - _mm256_cvtepi32_ps(cell), s = shifted - _mm256_cvtepi32_ps(face);
    const std::ptrdiff_t dx = side * side, dy = side;
    // Of each component's lowest sample: indices and strides are below 2^15.
    const __m256i stride =
        _mm256_broadcastsi128_si256(_mm_setr_epi32(static_cast<int>(dx), static_cast<int>(dy), 1, 0));
    const __m256i part = _mm256_madd_epi16(cell, stride);
    const __m256i base = _mm256_add_epi32(
        _mm256_shuffle_epi32(part, 0x00),
        _mm256_add_epi32(_mm256_shuffle_epi32(part, 0x55), _mm256_shuffle_epi32(part, 0xaa)));
    const __m256i offset = _mm256_add_epi32(base, _mm256_madd_epi16(_mm256_sub_epi32(face, cell), stride));
    const __m128i near2 = _mm256_castsi256_si128(offset), far2 = _mm256_extracti128_si256(offset, 1);
    const auto faceOf = [&](const float* p, const float* q, Float8 tx) {
      const Float8 low = joined8(facePoints(p, dy), facePoints(q, dy));
      return low + tx * (joined8(facePoints(p + dx, dy), facePoints(q + dx, dy)) - low);
    };
    const Float8 cellX = _mm256_permute_ps(t, 0x00);
    const Float8 a = faceOf(component[0] + _mm_cvtsi128_si32(near2), component[0] + _mm_cvtsi128_si32(far2),
                            _mm256_permute_ps(s, 0x00));
    const Float8 b =
        faceOf(component[1] + _mm_extract_epi32(near2, 1), component[1] + _mm_extract_epi32(far2, 1), cellX);
    const Float8 c =
        faceOf(component[2] + _mm_extract_epi32(near2, 2), component[2] + _mm_extract_epi32(far2, 2), cellX);
    // From one component with four corners in each to one corner with three components in each.
    const Float8 ab01 = _mm256_unpacklo_ps(a, b), cc01 = _mm256_unpacklo_ps(c, c),
                 ab23 = _mm256_unpackhi_ps(a, b), cc23 = _mm256_unpackhi_ps(c, c);
    const Float8 p00 = _mm256_shuffle_ps(ab01, cc01, 0x44), p01 = _mm256_shuffle_ps(ab01, cc01, 0xee),
                 p10 = _mm256_shuffle_ps(ab23, cc23, 0x44), p11 = _mm256_shuffle_ps(ab23, cc23, 0xee);
    const Float8 y = _mm256_blend_ps(_mm256_permute_ps(t, 0x55), _mm256_permute_ps(s, 0x55), 0x22);
    const Float8 z = _mm256_blend_ps(_mm256_permute_ps(t, 0xaa), _mm256_permute_ps(s, 0xaa), 0x44);
    const Float8 low = p00 + y * (p10 - p00), high = p01 + y * (p11 - p01);
    return low + z * (high - low);
  }
};

}  // namespace fluidtex::sim
