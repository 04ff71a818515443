// A sum of plane waves that go round the square and the loop a whole number of times, faster the shorter they
// are, as waves in deep water do. Where their crests bundle the light it is bright, and slopes towards the
// sky show it.
#include "scenes/exemplars/ripples.h"

#include "scenes/exemplars/pattern.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fluidtex::exemplars {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

struct Wave {
  double x, y;    // times round the square
  double cycles;  // times round the loop
  double slope;   // steepness
  double phase;
};

std::vector<Wave> wavesOf(const Ripples& options) {
  std::vector<Wave> waves;
  double square = 0.0;
  for (std::uint64_t n = 0; waves.size() < std::size_t(options.waves); ++n) {
    const auto draw = [&](std::uint64_t what) { return random(options.seed, n, what, 0); };
    const double x = std::round(32.0 * draw(1) - 16.0), y = std::round(32.0 * draw(2) - 16.0);
    const double length = std::hypot(x, y);
    if (length < 3.0 || length > 16.0) continue;
    const double slope = (0.5 + draw(3)) * std::exp(-0.06 * length);
    waves.push_back({x, y, std::max(1.0, std::round(0.8 * std::sqrt(length))), slope, kTurn * draw(4)});
    square += 0.5 * slope * slope;
  }
  for (Wave& wave : waves) wave.slope /= std::sqrt(square);
  return waves;
}

}  // namespace

std::vector<std::uint8_t> makeRipples(const Ripples& options, int n) {
  const std::vector<Wave> waves = wavesOf(options);
  const double t = double(n) / options.pictures;
  return rendered(options.size, options.samples, [&](double x, double y) {
    double height = 0.0, slopeY = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
    for (const Wave& wave : waves) {
      const double length = std::hypot(wave.x, wave.y);
      const double angle = kTurn * (wave.x * x + wave.y * y - wave.cycles * t) + wave.phase;
      const double rise = wave.slope * std::sin(angle), bend = wave.slope * std::cos(angle) / length;
      height += bend / length;
      slopeY -= rise * wave.y / length;
      xx -= bend * wave.x * wave.x;
      xy -= bend * wave.x * wave.y;
      yy -= bend * wave.y * wave.y;
    }
    // The area to which a bundle of parallel rays has shrunk at the bottom, over what it was at the surface.
    constexpr double kDepth = 0.065;
    const double shrunk = std::abs((1.0 + kDepth * xx) * (1.0 + kDepth * yy) - kDepth * kDepth * xy * xy);
    const double bright = 1.0 / (shrunk + 0.12);
    const Color deep{0.006, 0.060, 0.100}, shallow{0.018, 0.130, 0.165}, light{0.60, 0.90, 0.86},
        sky{0.46, 0.60, 0.72};
    const Color body = mixed(deep, shallow, smooth(-0.04, 0.04, height));
    const Color lit = mixed(body, light, std::min(0.9, 0.02 + 0.17 * std::max(0.0, bright - 0.85)));
    return mixed(lit, sky, 0.35 * smooth(0.8, 2.2, slopeY));
  });
}

}  // namespace fluidtex::exemplars
