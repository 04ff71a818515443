// Noise: Perlin, "Improving noise", 2002, with hashed gradients.
#include "scenes/terrain/terrain.h"

#include "numerics/random.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fluidtex::terrain {
namespace {

constexpr double kPi = std::numbers::pi;

double smooth(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

double bell(double x, double middle, double width) {
  return std::exp(-(x - middle) * (x - middle) / (width * width));
}

// The larger of two heights, rounded over `width` metres.
double smoothMax(double a, double b, double width) {
  const double t = std::max(width - std::abs(a - b), 0.0) / width;
  return std::max(a, b) + 0.25 * t * t * width;
}

// Slope of the noise at a lattice point towards (dx, dy).
double gradient(int i, int j, std::uint32_t seed, double dx, double dy) {
  const std::uint64_t z = seed * 0x9e3779b97f4a7c15ull +
                          static_cast<std::uint32_t>(i) * 0xff51afd7ed558ccdull +
                          static_cast<std::uint32_t>(j) * 0xc4ceb9fe1a85ec53ull;
  const double angle = 2.0 * kPi * static_cast<double>(finalised(z) >> 11) * 0x1p-53;
  return dx * std::cos(angle) + dy * std::sin(angle);
}

// About -0.7 to 0.7.
double noise(double x, double y, std::uint32_t seed) {
  const double fx = std::floor(x), fy = std::floor(y), dx = x - fx, dy = y - fy;
  const int i = static_cast<int>(fx), j = static_cast<int>(fy);
  const auto fade = [](double t) { return t * t * t * (t * (t * 6.0 - 15.0) + 10.0); };
  const double low =
      std::lerp(gradient(i, j, seed, dx, dy), gradient(i + 1, j, seed, dx - 1.0, dy), fade(dx));
  const double high = std::lerp(gradient(i, j + 1, seed, dx, dy - 1.0),
                                gradient(i + 1, j + 1, seed, dx - 1.0, dy - 1.0), fade(dx));
  return std::lerp(low, high, fade(dy));
}

// Octaves of it, each of half the size.
double roughness(double x, double y, std::uint32_t seed, int octaves) {
  double sum = 0.0, share = 1.0;
  for (int n = 0; n < octaves; ++n, share *= 0.5, x *= 2.0, y *= 2.0)
    sum += share * noise(x, y, seed + static_cast<std::uint32_t>(n));
  return sum;
}

template <class Height>
Ground makeGround(double width, double depth, double pixel, const Height& height) {
  Ground ground{
      static_cast<int>(std::lround(width / pixel)), static_cast<int>(std::lround(depth / pixel)), pixel, {}};
  ground.heights.reserve(std::size_t(ground.width) * std::size_t(ground.height));
  for (int row = 0; row < ground.height; ++row) {
    for (int column = 0; column < ground.width; ++column)
      ground.heights.push_back(
          static_cast<float>(height((column + 0.5) * pixel, (ground.height - row - 0.5) * pixel)));
  }
  return ground;
}

// y of the stream's middle, metres.
double courseAt(double x) {
  return 1.0 + 0.30 * std::sin(2.0 * kPi * (x - 0.35) / 4.0);
}

struct Rock {
  double x, across, radius;  // across: metres from the stream's middle, to the left
};

constexpr Rock kRocks[] = {
    {0.85, 0.16, 0.11}, {1.20, -0.20, 0.14}, {1.55, 0.02, 0.07},  {2.28, 0.14, 0.08},  {2.42, -0.16, 0.10},
    {3.05, 0.20, 0.15}, {3.25, -0.12, 0.10}, {3.62, 0.05, 0.09},  {3.72, -0.30, 0.13}, {0.55, -0.46, 0.12},
    {1.85, 0.48, 0.15}, {2.85, -0.52, 0.16}, {2.20, -0.62, 0.10}, {3.45, 0.55, 0.12},
};

double streamHeight(double x, double y) {
  const double middle = courseAt(x);
  // Distance from the course, across it.
  const double slope = (courseAt(x + 0.01) - courseAt(x - 0.01)) / 0.02;
  const double across = (y - middle) / std::hypot(1.0, slope);
  const double half = 0.36 - 0.13 * bell(x, 1.9, 0.35) + 0.06 * bell(x, 3.3, 0.5);
  const double floor = 0.40 - 0.02 * x - 0.13 * smooth(2.6, 2.85, x);
  const double wobble = 0.05 * noise(3.0 * x, 3.0 * y, 11);
  const double bank = smooth(0.55 * half, 1.75 * half, std::abs(across) + wobble);
  const double hills =
      0.30 + 0.05 * roughness(1.3 * x, 1.3 * y, 21, 3) + 0.10 * smooth(0.4, 1.2, std::abs(across));
  double height = floor + bank * hills + 0.012 * roughness(7.0 * x, 7.0 * y, 31, 4) * (0.5 + bank);
  for (const Rock& rock : kRocks) {
    const double dx = x - rock.x, dy = y - courseAt(rock.x) - rock.across;
    // Not quite round, and buried by a third.
    const double angle = std::atan2(dy, dx);
    const double radius =
        rock.radius * (1.0 + 0.22 * noise(1.5 * std::cos(angle) + 9.0 * rock.x, 1.5 * std::sin(angle), 41));
    const double reach = 1.0 - (dx * dx + dy * dy) / (radius * radius);
    if (reach <= 0.0) continue;
    const double rockFloor = 0.40 - 0.02 * rock.x - 0.13 * smooth(2.6, 2.85, rock.x) +
                             0.30 * smooth(0.20, 0.6, std::abs(rock.across));
    const double dome = rockFloor - 0.35 * rock.radius +
                        1.25 * rock.radius * std::sqrt(reach) * (1.0 + 0.12 * noise(20.0 * x, 20.0 * y, 51));
    height = smoothMax(height, dome, 0.02);
  }
  return height;
}

// A gully that leaves the crater's rim at this angle (radians) and runs down the flank.
struct Gully {
  double angle, depth, width;
};
constexpr Gully kGullies[] = {{-0.55 * kPi, 0.19, 0.10}, {-0.22 * kPi, 0.13, 0.08}};

double mountainHeight(double x, double y) {
  const double dx = x - 1.5, dy = y - 1.5, r = std::hypot(dx, dy), angle = std::atan2(dy, dx);
  // Ribs grow downwards; the noise is taken on a circle so that it closes.
  const double ribs = noise(2.6 * std::cos(angle), 2.6 * std::sin(angle) + 0.8 * r, 61) +
                      0.5 * noise(6.0 * std::cos(angle), 6.0 * std::sin(angle) + 1.5 * r, 62);
  const double cone = 1.5 * std::exp(-std::max(r - 0.05, 0.0) / 0.58);
  const double flank = cone * (1.0 + 0.25 * ribs * smooth(0.2, 0.8, r)) +
                       0.05 * roughness(3.0 * x, 3.0 * y, 71, 5) * smooth(0.2, 0.6, r);
  // The crater, and the gullies through which it overflows.
  const double bowl = 0.86 + 1.9 * r * r;
  double height = std::lerp(bowl, flank, smooth(0.26, 0.42, r));
  for (const Gully& gully : kGullies) {
    const double along = dx * std::cos(gully.angle) + dy * std::sin(gully.angle),
                 across = dy * std::cos(gully.angle) - dx * std::sin(gully.angle);
    const double widens =
        gully.width + 0.12 * std::max(along, 0.0) + 0.03 * noise(3.0 * along, gully.angle, 81);
    height -= gully.depth * bell(across, 0.03 * noise(4.0 * along, gully.angle, 82), widens) *
              smooth(0.16, 0.28, along) * (1.0 - 0.75 * smooth(0.5, 1.2, along));
  }
  return std::max(0.02, height);
}

}  // namespace

Ground streamBed() {
  return makeGround(4.0, 2.0, 1.0 / 128.0, streamHeight);
}

Ground mountain() {
  return makeGround(3.0, 3.0, 1.0 / 128.0, mountainHeight);
}

std::vector<std::uint16_t> greyValues(const Ground& ground, double low, double high) {
  std::vector<std::uint16_t> values;
  for (const float height : ground.heights) {
    const double share = std::clamp((height - low) / (high - low), 0.0, 1.0);
    values.push_back(static_cast<std::uint16_t>(std::lround(65535.0 * share)));
  }
  return values;
}

}  // namespace fluidtex::terrain
