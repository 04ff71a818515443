// A leaf is the lens between two arcs, toothed at its edge, with a rib along its middle from which veins go
// to both sides; it is darker towards its base and spotted by age.
#include "scenes/exemplars/leaves.h"

#include "scenes/exemplars/pattern.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace fluidtex::exemplars {
namespace {

constexpr std::array<Color, 6> kColors{{{0.62, 0.30, 0.04},    // amber
                                        {0.42, 0.09, 0.03},    // red
                                        {0.60, 0.42, 0.06},    // yellow
                                        {0.24, 0.10, 0.035},   // brown
                                        {0.22, 0.26, 0.05},    // green that fades
                                        {0.50, 0.20, 0.04}}};  // orange

struct Leaf {
  double x, y;           // its middle
  double along, across;  // half its length and width
  double cosine, sine;   // of its direction
  double bend;           // of its rib
  double shade;          // 0..1, its own
  Color color;
};

// Along the leaf, -1 at its base to 1 at its tip, and across it, -1 to 1 at its widest.
struct Place {
  double u, v;
};

class Foliage {
 public:
  explicit Foliage(const Leaves& options) : m_options(options) {}

  // The uppermost leaf's colour; nothing where there is water.
  Sample at(double x, double y) const {
    const int n = m_options.across, i = int(std::floor(x * n)), j = int(std::floor(y * n));
    double highest = -1.0;
    Sample result{{0.0, 0.0, 0.0}, 0.0};
    // A leaf reaches over the places next to its own but one.
    for (int b = j - 2; b <= j + 2; ++b)
      for (int a = i - 2; a <= i + 2; ++a) {
        const double height = drawn(a, b, 9);
        if (height <= highest || drawn(a, b, 8) > 0.58) continue;
        const Leaf leaf = leafAt(a, b);
        const Place place = placeOn(leaf, x, y);
        if (!covers(leaf, place)) continue;
        highest = height;
        result = {colorOf(leaf, place, x, y), 1.0};
      }
    return result;
  }

 private:
  double drawn(int i, int j, std::uint64_t what) const {
    return randomAt(m_options.seed, what, i, j, m_options.across);
  }

  Leaf leafAt(int i, int j) const {
    const double cell = 1.0 / m_options.across, angle = 2.0 * std::numbers::pi * drawn(i, j, 1);
    const double length = cell * (0.62 + 0.38 * drawn(i, j, 2));
    return {.x = (i + 0.5 + 0.7 * (drawn(i, j, 3) - 0.5)) * cell,
            .y = (j + 0.5 + 0.7 * (drawn(i, j, 4) - 0.5)) * cell,
            .along = length,
            .across = length * (0.36 + 0.16 * drawn(i, j, 5)),
            .cosine = std::cos(angle),
            .sine = std::sin(angle),
            .bend = 0.5 * (drawn(i, j, 6) - 0.5),
            .shade = drawn(i, j, 7),
            .color = kColors[std::size_t(drawn(i, j, 10) * 5.999)]};
  }

  static Place placeOn(const Leaf& leaf, double x, double y) {
    const double dx = x - leaf.x, dy = y - leaf.y;
    const double u = (dx * leaf.cosine + dy * leaf.sine) / leaf.along;
    const double v = (dy * leaf.cosine - dx * leaf.sine) / leaf.across;
    return {u, v - leaf.bend * (1.0 - u * u) * leaf.along / leaf.across};
  }

  // Half the leaf's width there, of its largest. Its base is round, its tip drawn out.
  static double widthAt(double u) {
    if (std::abs(u) >= 1.0) return 0.0;
    const double round =
        1.0 - std::pow(std::abs(u + 0.18) / (u > -0.18 ? 1.18 : 0.82), u > -0.18 ? 1.55 : 2.4);
    return std::max(0.0, round);
  }

  static bool covers(const Leaf& leaf, const Place& place) {
    const double across = std::abs(place.v);
    if (place.u < -0.8 && place.u > -1.12 && across < 0.035) return true;  // the stalk
    const double teeth = 0.045 * std::abs(std::fmod(place.u * 15.0 + leaf.shade + 30.0, 1.0) - 0.5);
    return across + teeth < widthAt(place.u);
  }

  Color colorOf(const Leaf& leaf, const Place& place, double x, double y) const {
    const double across = std::abs(place.v), width = std::max(widthAt(place.u), 1e-3);
    const double spots = fractal(m_options.seed, 20 + std::uint64_t(leaf.shade * 1e6), x, y, 64, 3, 0.6);
    double bright = 0.75 + 0.4 * leaf.shade + 0.22 * spots - 0.14 * place.u;
    // Halves tilt to and from the light.
    bright *= place.v > 0.0 ? 1.10 : 0.92;
    const double rib = 1.0 - smooth(0.02, 0.055, across);
    const double vein = std::abs(std::fmod(place.u * 7.0 - 2.2 * across + 20.0, 1.0) - 0.5);
    const double veins = (1.0 - smooth(0.03, 0.10, vein)) * (1.0 - smooth(0.75, 1.0, across / width));
    bright *= 1.0 + 0.38 * std::max(rib, 0.55 * veins);
    const double edge = smooth(0.72, 1.0, across / width);  // dry
    Color color = mixed(leaf.color, Color{0.16, 0.075, 0.025}, 0.55 * edge + 0.25 * smooth(0.2, 0.5, spots));
    for (double& channel : color) channel = std::clamp(channel * bright, 0.0, 1.0);
    return color;
  }

  Leaves m_options;
};

}  // namespace

std::vector<std::uint8_t> makeLeaves(const Leaves& options) {
  const Foliage foliage(options);
  return cutOut(options.size, options.samples, [&](double x, double y) { return foliage.at(x, y); });
}

}  // namespace fluidtex::exemplars
