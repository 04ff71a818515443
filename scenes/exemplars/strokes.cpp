#include "scenes/exemplars/strokes.h"

#include "scenes/exemplars/pattern.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace fluidtex::exemplars {
namespace {

constexpr std::array<Color, 8> kPaints{{{0.010, 0.040, 0.160},    // ultramarine
                                        {0.016, 0.120, 0.330},    // cobalt
                                        {0.040, 0.270, 0.450},    // cerulean
                                        {0.020, 0.180, 0.170},    // viridian
                                        {0.150, 0.430, 0.380},    // turquoise
                                        {0.060, 0.160, 0.060},    // sap green
                                        {0.720, 0.760, 0.700},    // white
                                        {0.560, 0.370, 0.100}}};  // ochre

class Painting {
 public:
  explicit Painting(const Strokes& options) : m_options(options) {}

  // The uppermost stroke's paint, or the ground below all.
  Color at(double x, double y) const {
    const int n = m_options.across, i = int(std::floor(x * n)), j = int(std::floor(y * n));
    double highest = -1.0;
    Color result{0.008, 0.03, 0.09};
    // A stroke is two places long to either side, and less than one across.
    for (int coat = 0; coat < m_options.coats; ++coat)
      for (int b = j - 1; b <= j + 1; ++b)
        for (int a = i - 3; a <= i + 3; ++a) {
          const double height = coat + drawn(coat, a, b, 9);
          if (height > highest && lays(coat, a, b, x, y, result)) highest = height;
        }
    return result;
  }

 private:
  double drawn(int coat, int i, int j, std::uint64_t what) const {
    return randomAt(m_options.seed + std::uint64_t(coat), what, i, j, m_options.across);
  }

  // Whether the stroke of that place has paint at (x, y), and which.
  bool lays(int coat, int i, int j, double x, double y, Color& color) const {
    const double cell = 1.0 / m_options.across, angle = 0.7 * (drawn(coat, i, j, 1) - 0.5);
    const double cx = (i + drawn(coat, i, j, 2)) * cell, cy = (j + drawn(coat, i, j, 3)) * cell;
    const double dx = x - cx, dy = y - cy, along = cell * (1.1 + 0.9 * drawn(coat, i, j, 4));
    const double across = cell * (0.22 + 0.16 * drawn(coat, i, j, 5));
    const double u = (dx * std::cos(angle) + dy * std::sin(angle)) / along;
    const double bent = 0.35 * (drawn(coat, i, j, 6) - 0.5) * (u * u - 0.4);
    const double v = (dy * std::cos(angle) - dx * std::sin(angle)) / across - bent * along / across;
    if (std::abs(u) > 1.1 || std::abs(v) > 1.0) return false;
    const auto own = std::uint64_t(drawn(coat, i, j, 7) * 1e6);
    // Bristles: they begin and end at different places, and run dry towards the end.
    const double bristle = noise(m_options.seed + own, 1, 0.5 * v + 0.5, 0.0, 13);
    const double fine = noise(m_options.seed + own, 2, 0.5 * v + 0.5, 0.0, 29);
    const double end = 0.80 + 0.24 * bristle, begin = -0.92 + 0.10 * fine;
    if (u > end || u < begin ||
        std::abs(v) > 0.86 + 0.14 * noise(m_options.seed + own, 3, 0.5 * u + 0.5, 0.0, 9))
      return false;
    const double dry = smooth(0.25, 1.0, u) * smooth(0.35, 0.75, noise(m_options.seed + own, 4, u, v, 24));
    if (dry * (0.5 + bristle) > 0.62) return false;

    const double which = drawn(coat, i, j, 8);
    const std::size_t paint = which < 0.86 ? std::size_t(which / 0.86 * 5.999) : which < 0.95 ? 6 : 7;
    const Color other = kPaints[std::size_t(drawn(coat, i, j, 10) * 5.999)];
    color = mixed(kPaints[paint], other, 0.35 * smooth(0.4, 0.9, bristle));
    // Ridges between the bristles' furrows, and the rim where paint was pushed aside.
    const double ridge = 0.70 + 0.42 * fine + 0.30 * bristle + 0.35 * smooth(0.72, 0.95, std::abs(v));
    for (double& channel : color) channel = std::clamp(channel * ridge, 0.0, 1.0);
    return true;
  }

  Strokes m_options;
};

}  // namespace

std::vector<std::uint8_t> makeStrokes(const Strokes& options) {
  const Painting painting(options);
  return rendered(options.size, options.samples, [&](double x, double y) { return painting.at(x, y); });
}

}  // namespace fluidtex::exemplars
