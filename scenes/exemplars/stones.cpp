// Stones are scattered cells drawn in from their borders and rounded off.
#include "scenes/exemplars/stones.h"

#include "scenes/exemplars/pattern.h"

#include <algorithm>
#include <cmath>

namespace fluidtex::exemplars {
namespace {

constexpr double kGap = 0.075;   // half the water between two stones, in stones' distances
constexpr double kRound = 0.42;  // how far in from its edge a stone rises

class Bed {
 public:
  explicit Bed(const Stones& options) : m_options(options) {}

  // 0 at the water.
  double heightAt(double x, double y) const {
    const Cell stone = stoneAt(x, y);
    const double in = std::clamp((stone.border - kGap) / kRound, 0.0, 1.0);
    const double dome = std::sqrt(in * (2.0 - in)) * (0.65 + 0.35 * stone.shade);
    const double rough = 0.10 * fractal(m_options.seed, 40, x, y, 5 * m_options.across, 4, 0.55);
    return std::clamp(dome * (0.93 + rough), 0.0, 1.0);
  }

  Sample at(double x, double y) const {
    const Cell stone = stoneAt(x, y);
    if (stone.border < kGap) return {{0.0, 0.0, 0.0}, 0.0};
    const std::uint64_t own = std::uint64_t(stone.shade * 1e6);
    const Color slate{0.16, 0.18, 0.20}, sand{0.40, 0.33, 0.25}, rust{0.24, 0.13, 0.08},
        pale{0.52, 0.50, 0.46};
    const double kind = random(m_options.seed, 50, own, 0), warm = random(m_options.seed, 51, own, 0);
    Color color =
        kind < 0.15 ? mixed(sand, pale, warm) : mixed(mixed(slate, sand, warm), rust, 0.5 * (1.0 - kind));
    const double grain = fractal(m_options.seed, 60 + own, x, y, 8 * m_options.across, 4, 0.65);
    const double vein = std::abs(fractal(m_options.seed, 70 + own, x, y, 2 * m_options.across, 3, 0.5));
    if (random(m_options.seed, 52, own, 0) > 0.6)
      color = mixed(color, pale, 0.75 * (1.0 - smooth(0.0, 0.035, vein)));
    // Wet and dark towards the water.
    const double bright = (0.85 + 0.5 * grain) * mixed(0.45, 1.0, smooth(kGap, kGap + 0.16, stone.border));
    for (double& channel : color) channel = std::clamp(channel * bright, 0.0, 1.0);
    return {color, 1.0};
  }

 private:
  Cell stoneAt(double x, double y) const {
    const int n = m_options.across;
    const double wx = x + 0.30 / n * fractal(m_options.seed, 10, x, y, n, 3, 0.5);
    const double wy = y + 0.30 / n * fractal(m_options.seed, 20, x, y, n, 3, 0.5);
    return cellAt(m_options.seed, 30, wx, wy, n);
  }

  Stones m_options;
};

}  // namespace

StoneImages makeStones(const Stones& options) {
  const Bed bed(options);
  return {cutOut(options.size, options.samples, [&](double x, double y) { return bed.at(x, y); }),
          levelMap(options.size, [&](double x, double y) { return bed.heightAt(x, y); })};
}

}  // namespace fluidtex::exemplars
