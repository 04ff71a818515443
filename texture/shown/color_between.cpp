#include "texture/shown/color_between.h"

#include "texture/exemplar/texel_place.h"
#include "texture/shown/shown_color.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace fluidtex::texture {
namespace {

// Neighbours within a patch are about a texel apart; texture compressed further than this is taken for a
// seam.
constexpr float kOnePiece = 3.0f;  // texels

// Wraps q to within half an exemplar of `near`.
Vec2f unwrapped(const Vec2f& q, const Vec2f& near, const TexturedSurface& surface) {
  const Vec2f size(float(surface.exemplarWidth), float(surface.exemplarHeight));
  Vec2f result = q;
  for (int i = 0; i < 2; ++i) result[i] -= size[i] * std::round((q[i] - near[i]) / size[i]);
  return result;
}

// Interpolated coordinate, if the three belong to one patch.
std::optional<Vec2f> placeBetween(const std::vector<Vec2f>& places, const Vec3I& corner, const Vec3f& weights,
                                  bool toroidal, const TexturedSurface& surface) {
  std::array<Vec2f, 3> q;
  for (int k = 0; k < 3; ++k) {
    q[k] = places[corner[k]];
    if (toroidal && k > 0) q[k] = unwrapped(q[k], q[0], surface);
  }
  for (int k = 0; k < 3; ++k)
    if (!((q[(k + 1) % 3] - q[k]).length() < kOnePiece)) return std::nullopt;
  return q[0] * weights[0] + q[1] * weights[1] + q[2] * weights[2];
}

}  // namespace

Detail makeDetail(Image color, bool toroidal, int exemplarWidth) {
  if (color.channels != 4 || color.data.empty())
    throw std::invalid_argument("makeDetail: the picture must be RGBA");
  const int finer = int(std::lround(std::log2(double(color.width) / double(std::max(exemplarWidth, 1)))));
  const int halvings = std::max(0, kMeanHalvings + finer);
  bool seeThrough = false;
  for (std::size_t i = 3; i < color.data.size(); i += 4) seeThrough = seeThrough || color.data[i] < 1.0f;
  Image around = lightnessAround(color, toroidal, halvings);
  return {std::move(color), std::move(around), halvings, toroidal, seeThrough};
}

std::optional<Vec4f> colorBetween(const Detail& detail, const TexturedSurface& surface,
                                  std::uint32_t triangle, const Vec3f& weights) {
  if (surface.coordinate.size() != surface.positions.size()) return std::nullopt;
  const Vec3I& corner = surface.triangles[triangle];
  const auto now = placeBetween(surface.coordinate, corner, weights, detail.toroidal, surface);
  if (!now) return std::nullopt;
  const TexelToImage toPicture(surface, detail.color);
  float left = 0.0f;
  int fading = 0;
  for (int k = 0; k < 3; ++k) {
    const float own = leftOf(surface.fading, corner[k]);
    left += weights[k] * own;
    fading += own > 0.0f;
  }
  const auto shown = [&](const Vec2f& present, const Vec2f& past, float weight) {
    return shownColor(detail.color, detail.around, detail.toroidal, toPicture(present), toPicture(past),
                      weight, detail.halvings);
  };
  if (fading == 0) return shown(*now, *now, 0.0f);
  // A corner that fades from nothing has no former coordinate.
  if (fading < 3) return std::nullopt;
  const auto former = placeBetween(surface.fading.coordinate, corner, weights, detail.toroidal, surface);
  if (!former) return std::nullopt;
  return shown(*now, *former, left);
}

}  // namespace fluidtex::texture
