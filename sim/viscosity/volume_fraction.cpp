#include "sim/viscosity/volume_fraction.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace fluidtex::sim {
namespace {

// Volume below the plane m1 x + m2 y + m3 z = alpha in the unit cube; 0 <= m1 <= m2 <= m3, m1 + m2 + m3 = 1,
// alpha at most 1/2.
double lowerVolume(double m1, double m2, double m3, double alpha) {
  // Products of slopes this small belong to a plane that stands along an axis, where the other cases hold.
  constexpr double kTiny = 1e-12;
  const double m12 = m1 + m2;
  if (alpha < m1) return alpha * alpha * alpha / std::max(6.0 * m1 * m2 * m3, kTiny);
  if (alpha < m2) return alpha * (alpha - m1) / (2.0 * m2 * m3) + m1 * m1 / std::max(6.0 * m2 * m3, kTiny);
  const auto cut = [alpha](double m) { return m * m * (m - 3.0 * alpha); };
  if (alpha < std::min(m12, m3)) {
    return (alpha * alpha * (3.0 * m12 - alpha) + cut(m1) + cut(m2)) / std::max(6.0 * m1 * m2 * m3, kTiny);
  }
  if (m12 <= m3) return (2.0 * alpha - m12) / (2.0 * m3);
  return (alpha * alpha * (3.0 - 2.0 * alpha) + cut(m1) + cut(m2) + cut(m3)) /
         std::max(6.0 * m1 * m2 * m3, kTiny);
}

}  // namespace

double negativeShare(double middle, double gx, double gy, double gz) {
  double m1 = std::abs(gx), m2 = std::abs(gy), m3 = std::abs(gz);
  const double sum = m1 + m2 + m3;
  if (std::abs(middle) >= 0.5 * sum) return middle < 0.0 ? 1.0 : 0.0;
  if (m1 > m2) std::swap(m1, m2);
  if (m2 > m3) std::swap(m2, m3);
  if (m1 > m2) std::swap(m1, m2);
  // Slopes that are negligible beside the largest one are raised to this share: the formulas divide by them.
  constexpr double kFlat = 1e-4;
  m1 = std::max(m1, kFlat * sum);
  m2 = std::max(m2, kFlat * sum);
  const double scale = m1 + m2 + m3;
  const double alpha = std::clamp(0.5 - middle / sum, 0.0, 1.0);
  const double below = lowerVolume(m1 / scale, m2 / scale, m3 / scale, std::min(alpha, 1.0 - alpha));
  return alpha <= 0.5 ? below : 1.0 - below;
}

}  // namespace fluidtex::sim
