#include "texture/measure/spectrum.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace fluidtex::texture {
namespace {

using Complex = std::complex<double>;
constexpr double kFloor = 1e-6;  // of the largest power

// exp(-2 pi i n / size)
std::vector<Complex> rootsOf(int size) {
  std::vector<Complex> roots;
  for (int n = 0; n < size; ++n) roots.push_back(std::polar(1.0, -2.0 * std::numbers::pi * n / size));
  return roots;
}

// Of one picture. Directly: its sides are a few dozen, and seldom powers of two.
std::vector<double> spectrumOf(const Stack& pictures, int picture, const std::vector<Complex>& roots) {
  const int size = pictures.width;
  const auto at = [size](int y, int x) { return std::size_t(y) * std::size_t(size) + std::size_t(x); };
  double mean = 0.0;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) mean += double(*pictures.at(picture, y, x)) / (double(size) * size);
  const auto hann = [&](int n) { return 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * (n + 0.5) / size); };
  std::vector<Complex> rows(at(size, 0));
  for (int y = 0; y < size; ++y)
    for (int p = 0; p < size; ++p) {
      Complex sum = 0.0;
      for (int x = 0; x < size; ++x)
        sum += hann(x) * (double(*pictures.at(picture, y, x)) - mean) * roots[std::size_t(p * x % size)];
      rows[at(y, p)] = hann(y) * sum;
    }
  const int half = size / 2;
  std::vector<double> power(std::size_t(half), 0.0), count(std::size_t(half), 0.0);
  for (int p = 0; p < size; ++p)
    for (int q = 0; q < size; ++q) {
      const double length = std::hypot(std::min(p, size - p), std::min(q, size - q));
      const auto k = int(std::lround(length));
      if (k < 1 || k > half) continue;
      Complex sum = 0.0;
      for (int y = 0; y < size; ++y) sum += rows[at(y, p)] * roots[std::size_t(q * y % size)];
      power[std::size_t(k - 1)] += std::norm(sum);
      count[std::size_t(k - 1)] += 1.0;
    }
  for (std::size_t k = 0; k < power.size(); ++k) power[k] /= std::max(count[k], 1.0);
  return power;
}

}  // namespace

std::vector<double> radialSpectrum(const Stack& pictures) {
  const std::vector<Complex> roots = rootsOf(pictures.width);
  std::vector<std::vector<double>> each(std::size_t(pictures.count));
  tbb::parallel_for(0, pictures.count, [&](int n) { each[std::size_t(n)] = spectrumOf(pictures, n, roots); });
  std::vector<double> mean(std::size_t(pictures.width / 2), 0.0);
  for (const std::vector<double>& one : each)
    for (std::size_t k = 0; k < mean.size(); ++k) mean[k] += one[k] / pictures.count;
  return mean;
}

double spectrumDistance(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0.0;
  for (const std::vector<double>* spectrum : {&a, &b})
    for (const double power : *spectrum) largest = std::max(largest, power);
  const double floor = kFloor * largest;
  double sum = 0.0;
  int count = 0;
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k) {
    if (std::max(a[k], b[k]) <= floor) continue;
    const double decibels = 10.0 * std::log10(std::max(a[k], floor) / std::max(b[k], floor));
    sum += decibels * decibels;
    ++count;
  }
  return count > 0 ? std::sqrt(sum / count) : 0.0;
}

}  // namespace fluidtex::texture
