// Small pictures to test with, made by formulas: linear RGBA, periodic, so that they may be taken as toroidal
// or not.
#pragma once

#include "numerics/random.h"
#include "texture/exemplar/exemplar.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace fluidtex::testing {

using namespace fluidtex::texture;

// Smooth periodic noise, 0..1: values at the corners of cells of `cell` pixels, blended smoothly.
inline float smoothNoise(float x, float y, int size, int cell, std::uint64_t seed) {
  const int cells = size / cell;
  const auto corner = [&](int i, int j) {
    return float(
        randomUnit(seed, std::uint64_t(((j % cells + cells) % cells) * cells + (i % cells + cells) % cells)));
  };
  const float u = x / float(cell), v = y / float(cell);
  const int i = int(std::floor(u)), j = int(std::floor(v));
  const auto ease = [](float t) { return t * t * (3.0f - 2.0f * t); };
  const float s = ease(u - float(i)), t = ease(v - float(j));
  return (1 - t) * ((1 - s) * corner(i, j) + s * corner(i + 1, j)) +
         t * ((1 - s) * corner(i, j + 1) + s * corner(i + 1, j + 1));
}

template <class Color>
Image paint(int width, int height, const Color& color) {
  Image image{width, height, 4, {}};
  image.data.resize(std::size_t(width) * std::size_t(height) * 4);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) color(float(x), float(y), image.at(x, y));
  return image;
}

// Wavy stripes of uneven width.
inline Image stripes(int size) {
  return paint(size, size, [&](float x, float y, float* c) {
    const float bend = 9.0f * smoothNoise(x, y, size, 32, 1);
    const float wave = 0.5f + 0.5f * std::sin(2.0f * float(M_PI) * (y / 16.0f + bend / 8.0f));
    const float grain = 0.15f * smoothNoise(x, y, size, 4, 2);
    c[0] = 0.7f * wave + grain, c[1] = 0.5f * wave * wave + grain, c[2] = 0.1f + grain, c[3] = 1.0f;
  });
}

// Cells of about 20 pixels with dark walls and colours of their own.
inline Image cells(int size) {
  constexpr int kCell = 16;
  const int across = size / kCell;
  return paint(size, size, [&](float x, float y, float* c) {
    float nearest = 1e9f, second = 1e9f;
    std::uint64_t owner = 0;
    for (int j = int(y) / kCell - 2; j <= int(y) / kCell + 2; ++j)
      for (int i = int(x) / kCell - 2; i <= int(x) / kCell + 2; ++i) {
        const std::uint64_t id = std::uint64_t((j + across) % across * across + (i + across) % across);
        const float dx = (float(i) + float(randomUnit(5, 2 * id))) * kCell - x;
        const float dy = (float(j) + float(randomUnit(5, 2 * id + 1))) * kCell - y;
        const float distance = std::sqrt(dx * dx + dy * dy);
        if (distance < nearest)
          second = nearest, nearest = distance, owner = id;
        else
          second = std::min(second, distance);
      }
    const float wall = std::clamp((second - nearest) / 3.0f, 0.0f, 1.0f);
    for (std::uint64_t k = 0; k < 3; ++k) c[k] = wall * (0.2f + 0.6f * float(randomUnit(6, 3 * owner + k)));
    c[3] = 1.0f;
  });
}

// Noise of three octaves in three colours.
inline Image clouds(int size) {
  return paint(size, size, [&](float x, float y, float* c) {
    for (int k = 0; k < 3; ++k)
      c[k] = 0.5f * smoothNoise(x, y, size, 32, 10 + std::uint64_t(k)) +
             0.3f * smoothNoise(x, y, size, 16, 20 + std::uint64_t(k)) +
             0.2f * smoothNoise(x, y, size, 8, 30);
    c[3] = 1.0f;
  });
}

inline float largestDifference(const std::vector<float>& a, const std::vector<float>& b) {
  if (a.size() != b.size()) return std::numeric_limits<float>::infinity();
  float most = 0.0f;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

}  // namespace fluidtex::testing
