#include "texture/shown/maps.h"

#include "texture/exemplar/texel_place.h"
#include "texture/loops/parallel.h"
#include "texture/shown/shown_color.h"
#include "texture/shown/vector_maps.h"

namespace fluidtex::texture {

void lookUpMap(const std::string& name, const Image& map, bool toroidal, TexturedSurface& surface) {
  const TexelToImage toMap(surface, map);
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
    sampleCubic(map, toroidal, toMap(surface.coordinate[v]), now);
    const float weight = leftOf(surface.fading, v);
    if (weight > 0.0f) sampleCubic(map, toroidal, toMap(surface.fading.coordinate[v]), former);
    for (std::size_t c = 0; c < results.size(); ++c)
      (*results[c])[v] = now[c] + weight * (former[c] - now[c]);
  });
}

void lookUp(const std::string& name, const ExemplarMap& map, bool toroidal, TexturedSurface& surface) {
  if (map.holds == MapHolds::values)
    lookUpMap(name, map.image, toroidal, surface);
  else
    lookUpVectors(name, map, toroidal, surface);
}

void lookUpColor(const Image& color, bool toroidal, TexturedSurface& surface) {
  const TexelToImage toColor(surface, color);
  if (color.channels != 4) throw std::invalid_argument("lookUpColor: colours must be RGBA");
  const Image around = lightnessAround(color, toroidal);
  surface.color.resize(surface.positions.size());
  forEachIndex(surface.color.size(), [&](std::uint32_t v) {
    const float weight = leftOf(surface.fading, v);
    const Vec2f former = weight > 0.0f ? toColor(surface.fading.coordinate[v]) : Vec2f(0.0f);
    surface.color[v] = shownColor(color, around, toroidal, toColor(surface.coordinate[v]), former, weight);
  });
}

}  // namespace fluidtex::texture
