#include "texture/exemplar/load_map.h"

#include "texture/exemplar/channels.h"
#include "texture/exemplar/read_image.h"

namespace fluidtex::texture {

Image vertexMap(Image map, int exemplarWidth, bool toroidal) {
  while (map.width >= 2 * exemplarWidth && map.width > 1 && map.height > 1) map = halve(map, toroidal);
  return map;
}

namespace {

// One channel if all three are equal, as grey pictures are often stored.
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

}  // namespace fluidtex::texture
