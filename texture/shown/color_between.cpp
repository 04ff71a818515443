#include "texture/shown/color_between.h"

#include "texture/exemplar/texel_place.h"
#include "texture/shown/shown_color.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace fluidtex::texture {

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

std::optional<Vec4f> colorBetween(const Detail& detail, const TexturedSurface& surface, const Joints& joints,
                                  std::uint32_t triangle, const Vec3f& weights) {
  if (surface.coordinate.size() != surface.positions.size()) return std::nullopt;
  const Vec3I& corner = surface.triangles[triangle];
  float left = 0.0f;
  for (int k = 0; k < 3; ++k) left += weights[k] * leftOf(surface.fading, corner[k]);
  const TexelToImage toPicture(surface, detail.color);
  const Torus torus(surface, detail.toroidal);
  const auto reading = [&](const std::array<Vec2f, 3>& corners) {
    const Vec2f pixel =
        toPicture(corners[0] * weights[0] + corners[1] * weights[1] + corners[2] * weights[2]);
    if (left == 0.0f) return Reading{samplePremultiplied(detail.color, detail.toroidal, pixel)};
    return readAt(detail.color, detail.around, detail.toroidal, pixel, detail.halvings);
  };
  const auto mixed = [&](const CornerPlaces& places) {
    Reading sum;
    for (int label = 0; label < 3; ++label) {
      const Reading one = reading(places[std::size_t(label)]);
      sum.color += one.color * weights[label];
      sum.mean += one.mean * weights[label];
    }
    return sum;
  };
  const Joint* joint = jointIn(joints, triangle);
  const auto read = [&](const std::vector<Vec2f>& coordinate, const CornerPlaces Joint::*places) {
    if (joint) return mixed(joint->*places);
    return reading({torus.brought(coordinate[corner[0]]), torus.brought(coordinate[corner[1]]),
                    torus.brought(coordinate[corner[2]])});
  };
  const Reading now = read(surface.coordinate, &Joint::shown);
  if (left == 0.0f) return straight(now.color);
  return faded(now, read(joints.former.places.coordinate, &Joint::former), left);
}

}  // namespace fluidtex::texture
