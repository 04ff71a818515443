// Products of complex numbers as tangent vectors. std::complex's product checks for infinities, which do not
// occur here and cost a branch in the innermost loops.
#pragma once

#include <complex>

namespace fluidtex::texture {

template <typename Real>
inline std::complex<Real> product(const std::complex<Real>& a, const std::complex<Real>& b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

// conj(a) * b: b in axes rotated by the unit number a.
template <typename Real>
inline std::complex<Real> conjugateProduct(const std::complex<Real>& a, const std::complex<Real>& b) {
  return {a.real() * b.real() + a.imag() * b.imag(), a.real() * b.imag() - a.imag() * b.real()};
}

}  // namespace fluidtex::texture
