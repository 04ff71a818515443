// A sum of plane waves that go round the square a whole number of times, most of them down the columns, with
// the steepness that wind gives short waves. Crests are sharper than troughs, as of a trochoid: places are
// moved towards the crests.
#include "scenes/exemplars/waves.h"

#include "scenes/exemplars/pattern.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fluidtex::exemplars {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

struct Wave {
  double x, y;   // times round the square
  double slope;  // steepness
  double phase;
};

std::vector<Wave> wavesOf(const Waves& options) {
  std::vector<Wave> waves;
  double square = 0.0;
  for (std::uint64_t n = 0; waves.size() < std::size_t(options.waves); ++n) {
    const auto draw = [&](std::uint64_t what) { return random(options.seed, n, what, 0); };
    const double x = std::round(80.0 * draw(1) - 40.0), y = std::round(40.0 * draw(2));
    const double length = std::hypot(x, y), straight = y / std::max(length, 1.0);
    if (length < 5.0 || length > 40.0 || draw(5) > std::pow(straight, 6.0)) continue;
    const double slope = (0.4 + draw(3)) / std::sqrt(length);
    waves.push_back({x, y, slope, kTurn * draw(4)});
    square += 0.5 * slope * slope;
  }
  for (Wave& wave : waves) wave.slope *= options.steep / std::sqrt(square);
  return waves;
}

struct Slope {
  double x, y;
};

Slope slopeAt(const std::vector<Wave>& waves, double x, double y) {
  const auto phaseOf = [&](const Wave& wave) { return kTurn * (wave.x * x + wave.y * y) + wave.phase; };
  // The way along which the water at (x, y) was moved.
  double awayX = 0.0, awayY = 0.0;
  for (const Wave& wave : waves) {
    const double length = std::hypot(wave.x, wave.y),
                 back = wave.slope * std::sin(phaseOf(wave)) / (kTurn * length);
    awayX += back * wave.x / length;
    awayY += back * wave.y / length;
  }
  x += 0.8 * awayX;
  y += 0.8 * awayY;
  Slope slope{0.0, 0.0};
  for (const Wave& wave : waves) {
    const double length = std::hypot(wave.x, wave.y), rise = -wave.slope * std::sin(phaseOf(wave));
    slope.x += rise * wave.x / length;
    slope.y += rise * wave.y / length;
  }
  return slope;
}

}  // namespace

WaveImages makeWaves(const Waves& options) {
  const std::vector<Wave> waves = wavesOf(options);
  WaveImages images;
  images.pixels = rendered(options.size, 1, [&](double x, double y) {
    const Slope slope = slopeAt(waves, x, y);
    const double light = std::clamp(0.38 - 0.45 * slope.y - 0.12 * slope.x, 0.0, 1.0);
    return Color{0.25 * light, 0.65 * light, light};
  });
  images.normals.reserve(3 * std::size_t(options.size) * options.size);
  for (int row = 0; row < options.size; ++row)
    for (int column = 0; column < options.size; ++column) {
      const Slope slope = slopeAt(waves, (column + 0.5) / options.size, (row + 0.5) / options.size);
      const double length = std::sqrt(1.0 + slope.x * slope.x + slope.y * slope.y);
      // y is down in the picture and up in the map.
      for (const double part : {-slope.x, slope.y, 1.0})
        images.normals.push_back(std::uint8_t(std::lround(127.5 * (part / length + 1.0))));
    }
  return images;
}

}  // namespace fluidtex::exemplars
