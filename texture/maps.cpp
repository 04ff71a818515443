#include "texture/maps.h"

#include "texture/channels.h"
#include "texture/parallel.h"
#include "texture/read_image.h"
#include "texture/shown_color.h"
#include "texture/texel_place.h"
#include "texture/vector_maps.h"

namespace fluidtex::texture {
Image vertexMap(Image map, int exemplarWidth, bool toroidal) {
  while (map.width >= 2 * exemplarWidth && map.width > 1 && map.height > 1) map = halve(map, toroidal);
  return map;
}

namespace {

// One channel where all three of a picture are alike, as grey pictures are often stored.
Image greyIfAlike(Image image) {
  if (image.channels != 3) return image;
  const std::size_t pixels = image.data.size() / 3;
  for (std::size_t i = 0; i < pixels; ++i) {
    const float* p = &image.data[3 * i];
    if (p[1] != p[0] || p[2] != p[0]) return image;
  }
  for (std::size_t i = 0; i < pixels; ++i) image.data[i] = image.data[3 * i];
  image.data.resize(pixels);
  image.channels = 1;
  return image;
}

}  // namespace

ExemplarMap loadMap(const MapOptions& options, int exemplarWidth, bool toroidal) {
  Image image = readMap(options.file);
  if (options.holds != MapHolds::values && image.channels != 3)
    throw ExemplarError(options.file.string() +
                        " is grey; a map of vectors must have x, y and z as red, green and blue.");
  if (options.holds == MapHolds::values) image = greyIfAlike(std::move(image));
  return {vertexMap(std::move(image), exemplarWidth, toroidal), options.holds, float(options.weight)};
}

std::vector<std::string> mapNames(const std::string& name, int channels) {
  if (channels == 1) return {name};
  return {name + "_red", name + "_green", name + "_blue"};
}

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
