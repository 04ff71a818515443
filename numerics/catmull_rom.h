// Catmull-Rom interpolation: the cubic of least order whose value and slope are continuous from sample to
// sample, exact for polynomials up to the second degree.
// Source: Catmull and Rom, "A class of local interpolating splines", 1974; Keys, "Cubic convolution
// interpolation for digital image processing", 1981, equation 15 (a = -1/2).
#pragma once

#include <array>

namespace fluidtex {

// Weights of the samples at -1, 0, 1 and 2 for a place t in [0, 1]. Their sum is 1.
template <typename T>
constexpr std::array<T, 4> catmullRom(T t) {
  const T t2 = t * t, t3 = t2 * t;
  return {T(0.5) * (T(2) * t2 - t - t3), T(0.5) * (T(2) - T(5) * t2 + T(3) * t3),
          T(0.5) * (t + T(4) * t2 - T(3) * t3), T(0.5) * (t3 - t2)};
}

// The derivatives of these weights. Their sum is 0.
template <typename T>
constexpr std::array<T, 4> catmullRomSlope(T t) {
  const T t2 = t * t;
  return {T(0.5) * (T(4) * t - T(1) - T(3) * t2), T(0.5) * (T(9) * t2 - T(10) * t),
          T(0.5) * (T(1) + T(8) * t - T(9) * t2), T(0.5) * (T(3) * t2 - T(2) * t)};
}

}  // namespace fluidtex
