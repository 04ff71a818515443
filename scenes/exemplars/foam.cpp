// Foam drifts together into nets: it lies along the borders of scattered cells, wider where there is more of
// it.
#include "scenes/exemplars/foam.h"

#include "scenes/exemplars/pattern.h"

#include <algorithm>
#include <cmath>

namespace fluidtex::exemplars {
namespace {

class Water {
 public:
  explicit Water(const FoamyWater& options) : m_options(options) {
    constexpr int kSide = 128;
    // Off all places that are looked up: ties would be decided by the last bit, which compilers differ in.
    constexpr double kOffset = 0.3819;
    for (int j = 0; j < kSide; ++j)
      for (int i = 0; i < kSide; ++i)
        m_levels.push_back(levelAt((i + kOffset) / kSide, (j + kOffset) / kSide));
    std::sort(m_levels.begin(), m_levels.end());
  }

  // How much foam there is at a place, 0..1: the share of the image that has less.
  double amountAt(double x, double y) const {
    const auto above = std::upper_bound(m_levels.begin(), m_levels.end(), levelAt(x, y));
    return double(above - m_levels.begin()) / double(m_levels.size());
  }

  Color colorAt(double x, double y) const {
    const double amount = amountAt(x, y);
    const double foam = foamAt(x, y, amount);
    const double bubbles = 0.86 + 0.28 * noise(m_options.seed, 50, x, y, m_options.size / 3);
    Color froth{0.74, 0.80, 0.80};
    for (double& channel : froth) channel = std::min(1.0, channel * bubbles);
    return mixed(waterAt(x, y, amount), froth, foam);
  }

 private:
  double levelAt(double x, double y) const {
    return 0.75 * noise(m_options.seed, 1, x, y, 3) + 0.25 * noise(m_options.seed, 2, x, y, 7);
  }

  // Share of the place that foam covers: a net of wide meshes, one of narrow meshes in its threads, and
  // froth.
  double foamAt(double x, double y, double amount) const {
    const std::uint64_t seed = m_options.seed;
    const int n = m_options.holes;
    const double wx = x + 0.5 / n * fractal(seed, 10, x, y, n, 3, 0.6);
    const double wy = y + 0.5 / n * fractal(seed, 20, x, y, n, 3, 0.6);
    const Cell hole = cellAt(seed, 30, wx, wy, n), small = cellAt(seed, 35, wx, wy, 3 * n);
    const double ragged = 0.16 * fractal(seed, 40, x, y, 4 * n, 2, 0.6);
    const double threads =
        0.55 * std::pow(amount, 1.8) - 0.055 + ragged * (0.2 + amount) - 0.08 * (hole.shade - 0.5);
    const double covered = threads > 0.0 ? smooth(0.0, 0.10, threads - hole.border) : 0.0;
    // Threads are thin in places, and let the water through small holes where there is little foam.
    const double pierced = smooth(0.0, 0.25, small.border - 0.24 + 0.5 * amount - 0.3 * small.shade);
    const double solid = smooth(0.35, 0.95, amount);
    return covered * mixed(0.45 + 0.4 * (1.0 - pierced), 0.97, solid);
  }

  // Dark and clear; lighter and greener where bubbles hang below the surface; a little of the sky on its
  // ripples.
  Color waterAt(double x, double y, double amount) const {
    const std::uint64_t seed = m_options.seed;
    const double bentX = x + 0.08 * fractal(seed, 70, x, y, 9, 3, 0.6);
    const double bentY = y + 0.08 * fractal(seed, 80, x, y, 9, 3, 0.6);
    const double ripples = fractal(seed, 60, bentX, bentY, 11, 4, 0.6);
    const Color deep{0.006, 0.035, 0.050}, milky{0.060, 0.190, 0.200}, sky{0.16, 0.24, 0.30};
    const Color body = mixed(deep, milky, std::clamp(0.75 * amount + 0.35 * ripples, 0.0, 1.0));
    return mixed(body, sky, 0.35 * smooth(-0.1, 0.55, ripples));
  }

  FoamyWater m_options;
  std::vector<double> m_levels;  // of places all over the image, rising
};

}  // namespace

FoamImages makeFoam(const FoamyWater& options) {
  const Water water(options);
  return {rendered(options.size, options.samples, [&](double x, double y) { return water.colorAt(x, y); }),
          levelMap(options.size, [&](double x, double y) { return water.amountAt(x, y); })};
}

}  // namespace fluidtex::exemplars
