#include "texture/maps.h"

#include "texture/channels.h"
#include "texture/parallel.h"

namespace fluidtex::texture {

Image vertexMap(Image map, int exemplarWidth, bool toroidal) {
  while (map.width >= 2 * exemplarWidth && map.width > 1 && map.height > 1) map = halve(map, toroidal);
  return map;
}

std::vector<std::string> mapNames(const std::string& name, int channels) {
  if (channels == 1) return {name};
  return {name + "_red", name + "_green", name + "_blue"};
}

void lookUpMap(const std::string& name, const Image& map, bool toroidal, TexturedSurface& surface) {
  if (map.data.empty() || (map.channels != 1 && map.channels != 3))
    throw std::invalid_argument("lookUpMap: the map must have pixels of one or three channels");
  if (surface.exemplarWidth < 1 || surface.exemplarHeight < 1)
    throw std::invalid_argument("lookUpMap: the surface must know the size of its exemplar");
  const std::size_t count = surface.positions.size();
  const Vec2f scale(float(map.width) / float(surface.exemplarWidth),
                    float(map.height) / float(surface.exemplarHeight));
  std::vector<std::vector<float>*> results;
  for (const std::string& own : mapNames(name, map.channels)) {
    results.push_back(&surface.maps[own]);
    results.back()->resize(count);
  }
  // Texel centres lie at integers, in the exemplar as in the map.
  const auto sample = [&](const Vec2f& texel, float* out) {
    const Vec2f half(0.5f, 0.5f);
    sampleBilinear(map, toroidal, (texel + half) * scale - half, out);
  };
  forEachIndex(count, [&](std::uint32_t v) {
    float now[3], former[3] = {0.0f, 0.0f, 0.0f};
    sample(surface.coordinate[v], now);
    const float weight = surface.fading.weight.empty() ? 0.0f : surface.fading.weight[v];
    if (weight > 0.0f) sample(surface.fading.coordinate[v], former);
    for (std::size_t c = 0; c < results.size(); ++c)
      (*results[c])[v] = now[c] + weight * (former[c] - now[c]);
  });
}

}  // namespace fluidtex::texture
