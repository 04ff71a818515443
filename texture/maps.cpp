#include "texture/maps.h"

#include "texture/channels.h"
#include "texture/parallel.h"
#include "texture/shown_color.h"

namespace fluidtex::texture {
namespace {

// From texels of a surface's exemplar to pixels of an image that lies over it.
class ToImage {
 public:
  ToImage(const TexturedSurface& surface, const Image& image)
      : m_scale(float(image.width) / float(surface.exemplarWidth),
                float(image.height) / float(surface.exemplarHeight)) {
    if (image.data.empty()) throw std::invalid_argument("lookUpMap: the map has no pixels");
    if (surface.exemplarWidth < 1 || surface.exemplarHeight < 1)
      throw std::invalid_argument("lookUpMap: the surface does not know the size of its exemplar");
  }
  // Centres lie at integers, in the exemplar as in the image.
  Vec2f operator()(const Vec2f& texel) const {
    const Vec2f half(0.5f, 0.5f);
    return (texel + half) * m_scale - half;
  }

 private:
  Vec2f m_scale;
};

// Of a vertex's former place.
float leftOf(const Fading& fading, std::uint32_t v) {
  return fading.weight.empty() ? 0.0f : fading.weight[v];
}

}  // namespace

Image vertexMap(Image map, int exemplarWidth, bool toroidal) {
  while (map.width >= 2 * exemplarWidth && map.width > 1 && map.height > 1) map = halve(map, toroidal);
  return map;
}

std::vector<std::string> mapNames(const std::string& name, int channels) {
  if (channels == 1) return {name};
  return {name + "_red", name + "_green", name + "_blue"};
}

void lookUpMap(const std::string& name, const Image& map, bool toroidal, TexturedSurface& surface) {
  const ToImage toMap(surface, map);
  if (map.channels != 1 && map.channels != 3)
    throw std::invalid_argument("lookUpMap: the map must have one or three channels");
  const std::size_t count = surface.positions.size();
  std::vector<std::vector<float>*> results;
  for (const std::string& own : mapNames(name, map.channels)) {
    results.push_back(&surface.maps[own]);
    results.back()->resize(count);
  }
  forEachIndex(count, [&](std::uint32_t v) {
    float now[3], former[3] = {0.0f, 0.0f, 0.0f};
    sampleBilinear(map, toroidal, toMap(surface.coordinate[v]), now);
    const float weight = leftOf(surface.fading, v);
    if (weight > 0.0f) sampleBilinear(map, toroidal, toMap(surface.fading.coordinate[v]), former);
    for (std::size_t c = 0; c < results.size(); ++c)
      (*results[c])[v] = now[c] + weight * (former[c] - now[c]);
  });
}

void lookUpColor(const Image& color, bool toroidal, TexturedSurface& surface) {
  const ToImage toColor(surface, color);
  if (color.channels != 4) throw std::invalid_argument("lookUpColor: colours must be RGBA");
  Exemplar shown;
  shown.toroidal = toroidal;
  shown.color = color;
  const Image around = meansAround(shown);
  surface.color.resize(surface.positions.size());
  forEachIndex(surface.color.size(), [&](std::uint32_t v) {
    const float weight = leftOf(surface.fading, v);
    const Vec2f former = weight > 0.0f ? toColor(surface.fading.coordinate[v]) : Vec2f(0.0f);
    surface.color[v] = shownColor(shown, around, toColor(surface.coordinate[v]), former, weight);
  });
}

}  // namespace fluidtex::texture
