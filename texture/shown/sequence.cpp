#include "texture/shown/sequence.h"

#include "texture/exemplar/texel_place.h"
#include "texture/loops/parallel.h"
#include "texture/shown/shown_color.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace fluidtex::texture {
namespace {

// Straight RGBA mixed as light that comes through.
Vec4f between(const Vec4f& a, const Vec4f& b, float share) {
  const auto premultiplied = [](const Vec4f& c) {
    return Vec4f(c[0] * c[3], c[1] * c[3], c[2] * c[3], c[3]);
  };
  if (share == 0.0f) return a;
  const Vec4f from = premultiplied(a), to = premultiplied(b);
  return straight(from + (to - from) * share);
}

void requireAlike(const Image& a, const Image& b) {
  if (a.channels != 4 || b.channels != 4 || a.width != b.width || a.height != b.height)
    throw std::invalid_argument("pictures of a sequence must be RGBA and of one size");
}

}  // namespace

ShownPictures picturesAt(const AnimationOptions& animation, std::size_t count, double seconds) {
  const auto pictures = double(count);
  double place = seconds * animation.rate;
  // A frame's time that is a picture's but for rounding shows that picture alone.
  if (std::abs(place - std::round(place)) < 1e-6) place = std::round(place);
  place = animation.loop ? std::fmod(place, pictures) : std::min(place, pictures - 1.0);
  const auto first = std::min(std::size_t(place), count - 1);
  return {first, animation.loop ? (first + 1) % count : std::min(first + 1, count - 1),
          float(place - double(first))};
}

ShownPictures picturesFor(std::size_t count, float level) {
  const float place = std::clamp(level, 0.0f, 1.0f) * float(count - 1);
  const auto first = std::min(std::size_t(place), count - 1);
  return {first, std::min(first + 1, count - 1), place - float(first)};
}

Image mixed(const Image& first, const Image& second, float share) {
  requireAlike(first, second);
  if (share == 0.0f) return first;
  Image result{first.width, first.height, 4, std::vector<float>(first.data.size())};
  forEachIndex(result.data.size() / 4, [&](std::uint32_t i) {
    const std::size_t at = 4 * std::size_t(i);
    const Vec4f color = between(Vec4f(&first.data[at]), Vec4f(&second.data[at]), share);
    std::copy_n(color.asPointer(), 4, &result.data[at]);
  });
  return result;
}

void lookUpColors(const std::vector<Image>& pictures, const std::vector<ShownPictures>& shown, bool toroidal,
                  TexturedSurface& surface) {
  const std::size_t count = surface.positions.size();
  if (shown.size() != count) throw std::invalid_argument("lookUpColors: pictures for each vertex");
  for (const ShownPictures& own : shown)
    if (std::max(own.first, own.second) >= pictures.size())
      throw std::invalid_argument("lookUpColors: there is no such picture");
  if (count == 0) return surface.color.clear();
  std::vector<Image> around;
  around.reserve(pictures.size());
  for (const Image& picture : pictures) {
    requireAlike(picture, pictures.front());
    around.push_back(lightnessAround(picture, toroidal));
  }
  const TexelToImage toColor(surface, pictures.front());
  surface.color.resize(count);
  forEachIndex(count, [&](std::uint32_t v) {
    const float weight = leftOf(surface.fading, v);
    const Vec2f now = toColor(surface.coordinate[v]);
    const Vec2f former = weight > 0.0f ? toColor(surface.fading.coordinate[v]) : Vec2f(0.0f);
    const auto colorIn = [&](std::size_t n) {
      return shownColor(pictures[n], around[n], toroidal, now, former, weight);
    };
    const ShownPictures& own = shown[v];
    const Vec4f first = colorIn(own.first);
    surface.color[v] = own.share > 0.0f ? between(first, colorIn(own.second), own.share) : first;
  });
}

}  // namespace fluidtex::texture
