// Surfaces for tests of joints: grids of vertices whose exemplar coordinates are linear in pieces.
#pragma once

#include "numerics/random.h"
#include "texture/joints/places.h"

#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>

namespace fluidtex::testing {

// A piece of texture: the coordinate as a linear function in space.
struct Piece {
  texture::Vec2f origin;  // texels, at x = 0
  texture::TexelGradient gradient;

  texture::Vec2f at(const texture::Vec3f& x) const { return texture::continued(origin, gradient, x); }
};

inline constexpr float kSheetSpacing = 0.1f;  // metres

// A flat sheet of n x n vertices in the plane z = 0, n - 1 squares of two triangles a side; the exemplar has
// 64 x 48 texels. Everything but the texture's coordinates is filled with values that are linear in x and y.
inline texture::TexturedSurface flatSheet(int n) {
  using namespace texture;
  TexturedSurface s;
  s.spacing = double(kSheetSpacing);
  s.exemplarWidth = 64, s.exemplarHeight = 48;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const float x = kSheetSpacing * float(i), y = kSheetSpacing * float(j);
      s.positions.emplace_back(x, y, 0.0f);
      s.normals.emplace_back(0.0f, 0.0f, 1.0f);
      s.orientation.emplace_back(1.0f, 0.0f, 0.0f);
      s.color.emplace_back(0.1f * x, 0.1f * y, 0.5f, 1.0f);
      s.age.push_back(x - 2.0f * y);
      s.trust.push_back(0.5f + 0.1f * x);
      s.previousPosition.emplace_back(x - 1.0f, y, 0.0f);
      s.velocity.emplace_back(y, x, 1.0f);
      s.contact.push_back(std::uint8_t(i % 2));
      s.maps["height"].push_back(3.0f * x + y);
      s.vectors["grain"].emplace_back(i % 2 ? 1.0f : 0.0f, i % 2 ? 0.0f : 1.0f, 0.0f);
    }
  for (int j = 0; j + 1 < n; ++j)
    for (int i = 0; i + 1 < n; ++i) {
      const auto at = [&](int a, int b) { return std::uint32_t((j + b) * n + i + a); };
      s.triangles.emplace_back(at(0, 0), at(1, 0), at(1, 1));
      s.triangles.emplace_back(at(0, 0), at(1, 1), at(0, 1));
    }
  s.fading = noFading(s.positions.size());
  return s;
}

// Gives each vertex the coordinate of pieces[which(position)], brought onto the exemplar.
inline void layPieces(const std::vector<Piece>& pieces,
                      const std::function<std::size_t(const texture::Vec3f&)>& which, bool toroidal,
                      texture::TexturedSurface& s) {
  const texture::Torus torus(s, toroidal);
  s.coordinate.clear(), s.gradient.clear();
  for (const texture::Vec3f& x : s.positions) {
    const Piece& piece = pieces[which(x)];
    s.coordinate.push_back(torus.brought(piece.at(x)));
    s.gradient.push_back(piece.gradient);
  }
}

// A torus (closed, n x n vertices) with the coordinates of random pieces, present and former, some fading.
inline texture::TexturedSurface patchedTorus(int n, std::uint64_t seed) {
  using namespace texture;
  TexturedSurface s = flatSheet(n);
  const double step = 2.0 * std::numbers::pi / n;
  s.triangles.clear();
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const double a = step * i, b = step * j, r = 1.0 + 0.4 * std::cos(b);
      const auto v = std::size_t(j * n + i);
      s.positions[v] = Vec3f(float(r * std::cos(a)), float(r * std::sin(a)), float(0.4 * std::sin(b)));
      s.normals[v] =
          Vec3f(float(std::cos(a) * std::cos(b)), float(std::sin(a) * std::cos(b)), float(std::sin(b)));
      const auto at = [&](int k, int l) { return std::uint32_t((j + l) % n * n + (i + k) % n); };
      s.triangles.emplace_back(at(0, 0), at(1, 0), at(1, 1));
      s.triangles.emplace_back(at(0, 0), at(1, 1), at(0, 1));
    }
  const auto random = [&](std::uint64_t i) { return float(randomUnit(seed, i)); };
  const auto piece = [&](std::uint64_t k) {
    const float turn = 6.28f * random(100 * k), scale = 8.0f;
    const Vec3f u(std::cos(turn), std::sin(turn), 0.3f), w(-std::sin(turn), std::cos(turn), -0.2f);
    return Piece{{64.0f * random(100 * k + 1), 48.0f * random(100 * k + 2)}, {u * scale, w * scale}};
  };
  const auto patch = [&](const Vec3f& x, float size) {
    std::uint64_t key = 0;
    for (int c = 0; c < 3; ++c) key = key * 64 + std::uint64_t(std::floor((x[c] + 2.0f) / size));
    return key % 7;
  };
  const Torus torus(s, true);
  s.coordinate.resize(s.positions.size()), s.gradient.resize(s.positions.size());
  for (std::size_t v = 0; v < s.positions.size(); ++v) {
    const Vec3f& x = s.positions[v];
    const Piece now = piece(patch(x, 0.35f)), old = piece(10 + patch(x, 0.5f));
    s.coordinate[v] = torus.brought(now.at(x)), s.gradient[v] = now.gradient;
    s.fading.coordinate[v] = torus.brought(old.at(x)), s.fading.gradient[v] = old.gradient;
    s.fading.weight[v] = std::max(0.0f, x.x() - 0.3f);
  }
  return s;
}

}  // namespace fluidtex::testing
