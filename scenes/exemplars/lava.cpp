// Plates are the cells of scattered sites (Worley, "A cellular texture basis function", 1996) in a space bent
// by noise. The distance to the nearest border, against a width that varies from place to place, says how far
// a crack is open; large plates are cracked once more, finely.
#include "scenes/exemplars/lava.h"

#include "scenes/exemplars/pattern.h"

#include <algorithm>
#include <cmath>

namespace fluidtex::exemplars {
namespace {

// Colour of what glows at a heat of 0 (just dark) to 1.
Color glow(double heat) {
  const Color dark{0.018, 0.002, 0.001}, red{0.42, 0.018, 0.004}, orange{0.95, 0.17, 0.012},
      gold{1.0, 0.55, 0.10};
  if (heat < 0.35) return mixed(dark, red, smooth(0.0, 0.35, heat));
  if (heat < 0.7) return mixed(red, orange, smooth(0.35, 0.7, heat));
  return mixed(orange, gold, smooth(0.7, 1.0, heat));
}

class Crust {
 public:
  explicit Crust(const Lava& options) : m_options(options) {}

  // Plates of crust, with cracks wide and narrow.
  Color colorAt(double x, double y) const {
    // How wide cracks are here: broad between plates, hair-fine within, closed in places.
    const std::uint64_t seed = m_options.seed;
    const double strain = noise(seed, 40, x, y, 4) * 0.6 + noise(seed, 41, x, y, 9) * 0.4;
    const double wide = 0.030 + 0.150 * smooth(0.35, 0.75, strain);
    const double fine = 0.13 * smooth(0.55, 0.95, noise(seed, 42, x, y, 6));
    return colorAt(x, y, {strain, wide, fine});
  }

  // How molten it is at a place where all stages lie side by side, 0..1.
  double stageAt(double x, double y) const {
    const std::uint64_t seed = m_options.seed;
    const double rough = 0.75 * noise(seed, 90, x, y, 3) + 0.25 * noise(seed, 91, x, y, 7);
    return smooth(0.12, 0.88, rough);
  }

  // Crust whose cracks open the farther the more molten it is.
  Color colorAtStage(double x, double y, double stage) const {
    const double wide = 0.55 * stage * stage - 0.03;
    const double fine = 0.20 * smooth(0.3, 0.8, stage) * noise(m_options.seed, 42, x, y, 9);
    return colorAt(x, y, {0.2 + 0.6 * stage, wide, fine});
  }

 private:
  // Widths of cracks between plates and within them, in units of the sites' distance; strain, 0..1: how hot
  // they are.
  struct Cracks {
    double strain, wide, fine;
  };

  Color colorAt(double x, double y, const Cracks& cracks) const {
    const std::uint64_t seed = m_options.seed;
    const int n = m_options.plates;
    const double wx = x + 0.34 / n * fractal(seed, 20, x, y, n, 4, 0.55);
    const double wy = y + 0.34 / n * fractal(seed, 30, x, y, n, 4, 0.55);
    const Cell plate = cellAt(seed, 1, wx, wy, n), piece = cellAt(seed, 5, wx, wy, 3 * n);

    const auto& [strain, wide, fine] = cracks;
    const double seam = fine > 0.0 ? 1.0 - piece.border / fine : 0.0;
    const double crack = std::max(wide > 0.0 ? 1.0 - plate.border / wide : 0.0, 0.5 * seam);

    // Crust: near black, browner where it is young, with wrinkles that the light picks out.
    const double e = 0.6 / m_options.size;
    const double slopeX = height(x + e, y, plate.border) - height(x - e, y, plate.border);
    const double slopeY = height(x, y + e, plate.border) - height(x, y - e, plate.border);
    const double light = std::clamp(0.75 - 60.0 * (0.55 * slopeX + 0.8 * slopeY), 0.15, 2.6);
    const Color old{0.030, 0.028, 0.030}, young{0.070, 0.044, 0.036};
    Color color = mixed(old, young, 0.65 * plate.shade + 0.35 * noise(seed, 50, x, y, 12));
    const double tone = light * (0.75 + 0.5 * noise(seed, 51, x, y, m_options.size / 2)) *
                        (0.55 + 0.45 * smooth(0.0, 0.18, plate.border));
    for (double& channel : color) channel *= tone;

    // The rims of the plates are warm; in the open crack the melt is hottest in the middle.
    const double rim =
        0.30 * std::exp(-std::max(0.0, plate.border - wide) / 0.055) * smooth(0.3, 0.9, strain);
    const double supply = 0.35 + 0.75 * smooth(0.3, 0.7, strain);
    const double heat = crack > 0.0 ? 0.18 + 0.85 * std::pow(crack, 0.8) * supply : 0.0;
    const double melt = smooth(0.0, 0.22, crack);
    const Color warm = glow(std::min(1.0, rim));
    for (std::size_t k = 0; k < 3; ++k)
      color[k] += warm[k] * (rim > 0.02 ? 1.0 : 0.0) * smooth(0.02, 0.1, rim);
    const double flicker = 0.9 + 0.2 * noise(seed, 60, x, y, 64);
    return mixed(color, glow(std::min(1.0, heat * flicker)), melt);
  }

  // Of the crust: swollen plates with ropes along them and a rough skin; in the units of the slopes' factor.
  double height(double x, double y, double border) const {
    const std::uint64_t seed = m_options.seed;
    const int n = m_options.plates;
    const double bend = fractal(seed, 70, x, y, n, 2, 0.5);
    const double ropes = noise(seed, 74, x + 0.10 * bend, y + 0.10 * bend, 5 * n);
    const double skin = fractal(seed, 80, x, y, 8 * n, 2, 0.6);
    return 0.010 * ropes + 0.006 * skin + 0.012 * smooth(0.0, 0.3, border);
  }

  Lava m_options;
};

}  // namespace

std::vector<std::uint8_t> makeLava(const Lava& options) {
  const Crust crust(options);
  return rendered(options.size, options.samples, [&](double x, double y) { return crust.colorAt(x, y); });
}

std::vector<std::uint8_t> makeLavaAtStage(double stage, const Lava& options) {
  const Crust crust(options);
  return rendered(options.size, options.samples,
                  [&](double x, double y) { return crust.colorAtStage(x, y, stage); });
}

CoolingLava makeCoolingLava(const Lava& options) {
  const Crust crust(options);
  return {rendered(options.size, options.samples,
                   [&](double x, double y) { return crust.colorAtStage(x, y, crust.stageAt(x, y)); }),
          levelMap(options.size, [&](double x, double y) { return crust.stageAt(x, y); })};
}

}  // namespace fluidtex::exemplars
