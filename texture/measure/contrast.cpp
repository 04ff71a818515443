#include "texture/measure/contrast.h"
#include "texture/measure/tiles.h"

#include <algorithm>
#include <cmath>

namespace fluidtex::texture {
Image contrastOf(const Image& color) {
  const Image value = seenLuminance(color);
  const int width = value.width, height = value.height;
  const auto at = [&](const Image& image, int x, int y) {
    return double(*image.at(std::clamp(x, 0, width - 1), std::clamp(y, 0, height - 1)));
  };
  Image squares{width, height, 1, {}}, result{width, height, 1, {}};
  double sum = 0.0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double dx = 0.5 * (at(value, x + 1, y) - at(value, x - 1, y));
      const double dy = 0.5 * (at(value, x, y + 1) - at(value, x, y - 1));
      squares.data.push_back(float(dx * dx + dy * dy));
      sum += dx * dx + dy * dy;
    }
  const double mean = sum / (double(width) * height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      double around = 0.0;
      for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i) around += at(squares, x + i, y + j) / 9.0;
      result.data.push_back(mean > 0.0 ? float(around / mean) : 1.0f);
    }
  return result;
}

std::optional<double> measureContrast(const TexturedSurface& surface, const Image& contrast) {
  if (surface.empty()) return std::nullopt;
  double sum = 0.0;
  for (const Vec2f& texel : surface.coordinate)
    sum += double(*contrast.at(std::clamp(int(std::lround(texel[0])), 0, contrast.width - 1),
                               std::clamp(int(std::lround(texel[1])), 0, contrast.height - 1)));
  return sum / double(surface.coordinate.size());
}

}  // namespace fluidtex::texture
