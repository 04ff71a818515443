// Rasterisation of a flattened piece.
#include "texture/neighborhood/flattener.h"

namespace fluidtex::texture {

void Flattener::fromTriangles(int window, PixelSource* pixels) const {
  constexpr double kOnEdge =
      1e-7;  // tolerance: a pixel on an edge belongs to either triangle; weights are clamped at zero
  const int radius = window / 2;
  const double limit = m_reach - 0.5 + 1e-6;  // for a complete neighbourhood this is the radius
  forEachTriangle([&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const Complexd p[3] = {m_placed[a].l, m_placed[b].l, m_placed[c].l};
    const auto [left, right] = std::minmax({p[0].real(), p[1].real(), p[2].real()});
    const auto [top, bottom] = std::minmax({p[0].imag(), p[1].imag(), p[2].imag()});
    const int i0 = std::max(-radius, int(std::ceil(left - kOnEdge)));
    const int i1 = std::min(radius, int(std::floor(right + kOnEdge)));
    const int j0 = std::max(-radius, int(std::ceil(top - kOnEdge)));
    const int j1 = std::min(radius, int(std::floor(bottom + kOnEdge)));
    if (i0 > i1 || j0 > j1) return;
    const double area = flatArea(a, b, c);
    if (area <= 1e-12) return;
    for (int j = j0; j <= j1; ++j) {
      for (int i = i0; i <= i1; ++i) {
        if (std::max(std::abs(i), std::abs(j)) > limit) continue;
        PixelSource& pixel = pixels[std::size_t(j + radius) * window + (i + radius)];
        if (!pixel.missing()) continue;
        const Complexd x(i, j);
        double weight[3];
        for (int k = 0; k < 3; ++k) {
          const Complexd u = p[(k + 1) % 3] - x, v = p[(k + 2) % 3] - x;
          weight[k] = 0.5 * (u.imag() * v.real() - u.real() * v.imag()) / area;
        }
        if (std::min({weight[0], weight[1], weight[2]}) < -kOnEdge) continue;
        for (double& w : weight) w = std::max(w, 0.0);
        const double sum = weight[0] + weight[1] + weight[2];
        pixel.vertex = {m_placed[a].vertex, m_placed[b].vertex, m_placed[c].vertex};
        pixel.weight = {float(weight[0] / sum), float(weight[1] / sum), float(weight[2] / sum)};
      }
    }
  });
}

// From the three nearest members, nearer ones weigh more.
void Flattener::fromNearest(int window, PixelSource* pixels) const {
  constexpr double kFarthest = 1.6;  // pixels
  const int radius = window / 2;
  const double limit = m_reach / double(m_view.pixel) - 0.5 + 1e-6;
  for (const Placed& placed : m_placed) {
    if (!m_view.isMember(placed.vertex)) continue;
    const Complexd l = placed.l / double(m_view.pixel);
    const int i0 = std::max(-radius, int(std::ceil(l.real() - kFarthest)));
    const int i1 = std::min(radius, int(std::floor(l.real() + kFarthest)));
    const int j0 = std::max(-radius, int(std::ceil(l.imag() - kFarthest)));
    const int j1 = std::min(radius, int(std::floor(l.imag() + kFarthest)));
    for (int j = j0; j <= j1; ++j)
      for (int i = i0; i <= i1; ++i) {
        const double distance = std::norm(l - Complexd(i, j));
        if (std::max(std::abs(i), std::abs(j)) > limit || distance > kFarthest * kFarthest) continue;
        PixelSource& pixel = pixels[std::size_t(j + radius) * window + (i + radius)];
        std::uint32_t vertex = placed.vertex;
        auto weight = float(1.0 / (distance + 0.05));
        for (int k = 0; k < 3; ++k)
          if (weight > pixel.weight[k])
            std::swap(weight, pixel.weight[k]), std::swap(vertex, pixel.vertex[k]);
      }
  }
  for (int i = 0; i < window * window; ++i) {
    PixelSource& pixel = pixels[i];
    if (pixel.missing()) continue;
    const float sum = pixel.weight[0] + pixel.weight[1] + pixel.weight[2];
    for (float& w : pixel.weight) w /= sum;
  }
}

}  // namespace fluidtex::texture
