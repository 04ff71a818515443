// Cubic Lagrange interpolation in a block of floats, z fastest: fourth-order where the field is smooth.
#pragma once

#include "sim/grid/trilinear.h"

namespace fluidtex::sim {

// Weights of the samples at -1, 0, 1 and 2 for a place t in [0, 1].
inline Float4 cubicWeights(float t) {
  const float a = t + 1.0f, c = t - 1.0f, d = t - 2.0f;
  return float4(t * c * d * (-1.0f / 6.0f), a * c * d * 0.5f, a * t * d * -0.5f, a * t * c * (1.0f / 6.0f));
}

// As trilinear; needs the samples around the box of eight, too.
inline float tricubic(const float* p, std::ptrdiff_t dx, std::ptrdiff_t dy, float tx, float ty, float tz) {
  alignas(16) float wx[4], wy[4];
  _mm_store_ps(wx, cubicWeights(tx));
  _mm_store_ps(wy, cubicWeights(ty));
  const float* const first = p - dx - dy - 1;
  Float4 sum{};
  for (int i = 0; i < 4; ++i) {
    Float4 plane{};
    for (int j = 0; j < 4; ++j) plane += wy[j] * load4(first + i * dx + j * dy);
    sum += wx[i] * plane;
  }
  sum = sum * cubicWeights(tz);
  sum = sum + _mm_movehl_ps(sum, sum);
  return sum[0] + sum[1];
}

}  // namespace fluidtex::sim
