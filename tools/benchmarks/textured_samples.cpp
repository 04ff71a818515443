#include "tools/benchmarks/textured_samples.h"

#include "scenes/exemplars/scales.h"
#include "texture/exemplar/srgb.h"
#include "texture/mesh/prepare.h"
#include "texture/orientation/orient.h"
#include "tools/benchmarks/moving_surfaces.h"

#include <algorithm>
#include <cmath>

namespace fluidtex::benchmarks {

texture::Image scales(int size) {
  exemplars::Scales options;
  options.columns = options.columns * size / options.size;
  // Even, or the picture would not meet at its edges.
  options.rows = 2 * int(std::lround(0.5 * options.rows * size / options.size));
  options.size = size;
  texture::Image image{size, size, 4, {}};
  const std::vector<std::uint8_t> pixels = exemplars::makeGreenScales(options);
  for (std::size_t i = 0; i < pixels.size(); i += 3) {
    for (std::size_t c = 0; c < 3; ++c)
      image.data.push_back(texture::decodeSrgb(float(pixels[i + c]) / 255.0f));
    image.data.push_back(1.0f);
  }
  return image;
}

texture::Surface sphere(int points, int levels) {
  const MovingSurface moving = movingSurface("sphere", points);
  texture::Surface surface =
      texture::prepareSurface(*moving.before, moving.spacing, texture::Seeds{}, levels, {});
  texture::orient(surface, {});
  return surface;
}

scenes::Scene stretchedSheet(int points) {
  scenes::Scene scene;
  scene.sim.size = {1.5, 1.5, 0.4};
  scene.sim.resolution = std::max(48, int(std::sqrt(0.5 * points)));
  scene.sim.liquid.push_back({{sim::Box{{-0.5, -0.5, 0.16}, {2.0, 2.0, 0.24}}}});
  scene.motion.flow = sim::MotionKind::stretch;
  scene.texture.points = points;
  return scene;
}

}  // namespace fluidtex::benchmarks
