#include "scenes/exemplars/pattern.h"

#include "numerics/random.h"

#include <algorithm>
#include <cmath>

namespace fluidtex::exemplars {

double random(std::uint64_t seed, std::uint64_t a, std::uint64_t b, std::uint64_t c) {
  const std::uint64_t x = seed * 0x9e3779b97f4a7c15u + a * 0xbf58476d1ce4e5b9u + b * 0x94d049bb133111ebu +
                          c * 0xd6e8feb86659fd93u;
  return double(finalised(finalised(x)) >> 11) * 0x1.0p-53;
}

double smooth(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

double mixed(double a, double b, double t) {
  return a + (b - a) * t;
}

Color mixed(const Color& a, const Color& b, double t) {
  return {mixed(a[0], b[0], t), mixed(a[1], b[1], t), mixed(a[2], b[2], t)};
}

int wrapped(int i, int n) {
  return ((i % n) + n) % n;
}

double randomAt(std::uint64_t seed, std::uint64_t what, int i, int j, int cells) {
  return random(seed, what, std::uint64_t(wrapped(i, cells)), std::uint64_t(wrapped(j, cells)));
}

double noise(std::uint64_t seed, std::uint64_t stream, double x, double y, int cells) {
  const double u = x * cells, v = y * cells;
  const int i = int(std::floor(u)), j = int(std::floor(v));
  const double s = smooth(0.0, 1.0, u - i), t = smooth(0.0, 1.0, v - j);
  const auto at = [&](int di, int dj) { return randomAt(seed, stream, i + di, j + dj, cells); };
  return mixed(mixed(at(0, 0), at(1, 0), s), mixed(at(0, 1), at(1, 1), s), t);
}

double fractal(std::uint64_t seed, std::uint64_t stream, double x, double y, int cells, int octaves,
               double gain) {
  double sum = 0.0, weight = 1.0;
  for (int octave = 0; octave < octaves; ++octave) {
    sum += weight * (noise(seed, stream + std::uint64_t(octave), x, y, cells) - 0.5);
    cells *= 2;
    weight *= gain;
  }
  return sum;
}

Cell cellAt(std::uint64_t seed, std::uint64_t stream, double x, double y, int cells) {
  const double u = x * cells, v = y * cells;
  const int i0 = int(std::floor(u)), j0 = int(std::floor(v));
  const auto site = [&](int i, int j, double& sx, double& sy) {
    const auto a = std::uint64_t(wrapped(i, cells)), b = std::uint64_t(wrapped(j, cells));
    sx = i + 0.08 + 0.84 * random(seed, stream, a, b);
    sy = j + 0.08 + 0.84 * random(seed, stream + 1, a, b);
  };
  int ni = i0, nj = j0;
  double nearest = 1e9, nx = 0.0, ny = 0.0;
  for (int j = j0 - 2; j <= j0 + 2; ++j) {
    for (int i = i0 - 2; i <= i0 + 2; ++i) {
      double sx, sy;
      site(i, j, sx, sy);
      const double d = std::hypot(sx - u, sy - v);
      if (d >= nearest) continue;
      nearest = d;
      ni = i, nj = j, nx = sx, ny = sy;
    }
  }
  Cell cell;
  cell.shade = random(seed, stream + 2, std::uint64_t(wrapped(ni, cells)), std::uint64_t(wrapped(nj, cells)));
  for (int j = nj - 2; j <= nj + 2; ++j) {
    for (int i = ni - 2; i <= ni + 2; ++i) {
      if (i == ni && j == nj) continue;
      double sx, sy;
      site(i, j, sx, sy);
      const double dx = sx - nx, dy = sy - ny, length = std::hypot(dx, dy);
      // To the line half way between the two sites.
      cell.border = std::min(cell.border, ((0.5 * (sx + nx) - u) * dx + (0.5 * (sy + ny) - v) * dy) / length);
    }
  }
  return cell;
}

double encoded(double linear) {
  const double value = std::clamp(linear, 0.0, 1.0);
  return value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1.0 / 2.4) - 0.055;
}

std::vector<std::uint8_t> levelMap(int size, const std::function<double(double x, double y)>& level) {
  std::vector<std::uint8_t> pixels;
  for (int j = 0; j < size; ++j)
    for (int i = 0; i < size; ++i)
      pixels.push_back(
          static_cast<std::uint8_t>(std::lround(255.0 * level((i + 0.5) / size, (j + 0.5) / size))));
  return pixels;
}

namespace {

// body(pixel, x, y) at samples x samples places in each pixel, row by row.
template <class Body>
void forEachSample(int size, int samples, const Body& body) {
  const double step = 1.0 / (double(size) * samples);
  for (int row = 0; row < size; ++row)
    for (int column = 0; column < size; ++column)
      for (int j = 0; j < samples; ++j)
        for (int i = 0; i < samples; ++i)
          body(std::size_t(row) * size + column, (column * samples + i + 0.5) * step,
               (row * samples + j + 0.5) * step);
}

std::uint8_t byteOf(double level) {
  return std::uint8_t(255.0 * level + 0.5);
}

}  // namespace

std::vector<std::uint8_t> rendered(int size, int samples, const std::function<Color(double, double)>& color) {
  std::vector<Color> sums(std::size_t(size) * size);
  forEachSample(size, samples, [&](std::size_t pixel, double x, double y) {
    const Color part = color(x, y);
    for (std::size_t k = 0; k < 3; ++k) sums[pixel][k] += part[k];
  });
  std::vector<std::uint8_t> pixels;
  pixels.reserve(3 * sums.size());
  for (const Color& sum : sums)
    for (const double channel : sum) pixels.push_back(byteOf(encoded(channel / (samples * samples))));
  return pixels;
}

std::vector<std::uint8_t> cutOut(int size, int samples, const std::function<Sample(double, double)>& sample) {
  std::vector<Sample> sums(std::size_t(size) * size);
  forEachSample(size, samples, [&](std::size_t pixel, double x, double y) {
    const Sample part = sample(x, y);
    for (std::size_t k = 0; k < 3; ++k) sums[pixel].color[k] += part.color[k] * part.alpha;
    sums[pixel].alpha += part.alpha;
  });
  std::vector<std::uint8_t> pixels;
  pixels.reserve(4 * sums.size());
  for (const Sample& sum : sums) {
    for (const double channel : sum.color)
      pixels.push_back(byteOf(encoded(sum.alpha > 0.0 ? channel / sum.alpha : 0.0)));
    pixels.push_back(byteOf(sum.alpha / (samples * samples)));
  }
  return pixels;
}

}  // namespace fluidtex::exemplars
