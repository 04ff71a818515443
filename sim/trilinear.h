// Trilinear interpolation in a block of floats, z fastest: the innermost loops of everything that moves along
// the velocity. Written with the four-wide instructions that every x86-64 has.
#pragma once

#include <immintrin.h>

#include <cstddef>

namespace fluidtex::sim {

// x, y, z in the first three lanes; the fourth is not looked at.
using Lanes = __m128;

inline Lanes lanes(float x, float y, float z, float w = 0.0f) {
  return _mm_setr_ps(x, y, z, w);
}
inline Lanes lanes(float all) {
  return _mm_set1_ps(all);
}
inline float lane0(Lanes a) {
  return _mm_cvtss_f32(a);
}
inline float lane1(Lanes a) {
  return _mm_cvtss_f32(_mm_shuffle_ps(a, a, 1));
}
inline float lane2(Lanes a) {
  return _mm_cvtss_f32(_mm_movehl_ps(a, a));
}

// The values at the upper (y, z), of the four corners of a cell's face at p: (0,0), (0,1), (1,0), (1,1).
inline Lanes facePoints(const float* p, std::ptrdiff_t dy) {
  const Lanes low = _mm_castpd_ps(_mm_load_sd(reinterpret_cast<const double*>(p)));
  return _mm_loadh_pi(low, reinterpret_cast<const __m64*>(p + dy));
}

// The box of eight samples whose lowest is p, at tx, ty, tz in [0, 1] of the way to the highest.
inline float trilinear(const float* p, std::ptrdiff_t dx, std::ptrdiff_t dy, float tx, float ty, float tz) {
  const Lanes low = facePoints(p, dy), high = facePoints(p + dx, dy);
  const Lanes face = low + lanes(tx) * (high - low);
  const Lanes edge = face + lanes(ty) * (_mm_movehl_ps(face, face) - face);
  const float from = lane0(edge);
  return from + tz * (lane1(edge) - from);
}

// Three blocks of one shape, whose samples lie half a cell lower than those of the first along x, y and z
// each: the components of a velocity on a staggered grid.
struct StaggeredBlocks {
  const float* component[3];
  std::ptrdiff_t side;  // samples along each axis

  // At `centred`, in cells from the first cell centre (the sample u(i, j, k) is at (i - 1/2, j, k)); all
  // samples needed must be there.
  [[gnu::always_inline]] Lanes at(Lanes centred) const {
    const Lanes shifted = centred + lanes(0.5f);
    const __m128i cell = _mm_cvttps_epi32(centred), face = _mm_cvttps_epi32(shifted);
    const Lanes t = centred - _mm_cvtepi32_ps(cell), s = shifted - _mm_cvtepi32_ps(face);
    const std::ptrdiff_t dx = side * side, dy = side;
    const std::ptrdiff_t i = _mm_cvtsi128_si32(cell), j = _mm_extract_epi32(cell, 1),
                         k = _mm_extract_epi32(cell, 2);
    const std::ptrdiff_t base = i * dx + j * dy + k;
    const float* const u = component[0] + base + (_mm_cvtsi128_si32(face) - i) * dx;
    const float* const v = component[1] + base + (_mm_extract_epi32(face, 1) - j) * dy;
    const float* const w = component[2] + base + (_mm_extract_epi32(face, 2) - k);
    const auto faceOf = [&](const float* p, Lanes tx) {
      const Lanes low = facePoints(p, dy);
      return low + tx * (facePoints(p + dx, dy) - low);
    };
    const Lanes cellX = _mm_shuffle_ps(t, t, 0x00);
    Lanes a = faceOf(u, _mm_shuffle_ps(s, s, 0x00)), b = faceOf(v, cellX), c = faceOf(w, cellX);
    // From one component with four corners in each to one corner with three components in each.
    Lanes d = c;
    _MM_TRANSPOSE4_PS(a, b, c, d);
    const Lanes y = _mm_blend_ps(_mm_shuffle_ps(t, t, 0x55), _mm_shuffle_ps(s, s, 0x55), 2);
    const Lanes z = _mm_blend_ps(_mm_shuffle_ps(t, t, 0xaa), _mm_shuffle_ps(s, s, 0xaa), 4);
    const Lanes near = a + y * (c - a), far = b + y * (d - b);
    return near + z * (far - near);
  }
};

}  // namespace fluidtex::sim
