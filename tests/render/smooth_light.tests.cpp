#include "render/smooth_light.h"
#include "render/path_tracer.h"
#include "shapes.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex;
using namespace fluidtex::render;
using namespace fluidtex::render::shapes;

namespace {

// A ball with dark spots on a floor, under sun and sky.
struct Scene {
  texture::TexturedSurface ball = sphere(Vec3f(0.5f, 0.5f, 0.3f), 0.3f, 4, Vec4f(1.0f));
  std::vector<Solid> solids{square(-4.0f, 5.0f, 0.0f, Vec3d(0.6))};
  Options options;

  explicit Scene(int samples) {
    for (std::size_t i = 0; i < ball.color.size(); ++i)
      ball.color[i] = i % 4 ? Vec4f(0.6f, 0.7f, 0.2f, 1.0f) : Vec4f(0.05f, 0.1f, 0.03f, 1.0f);
    options.width = 120;
    options.height = 68;
    options.samples = samples;
    options.noise = 0.0;
    options.surroundings.ground = options.surroundings.tank = false;
  }

  Layers layers() const { return traceLayers(ball, solids, options, unitView()); }
};

double difference(const std::vector<Vec3f>& a, const std::vector<Vec3f>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]).lengthSqr();
  return std::sqrt(sum / double(3 * a.size()));
}

// A wall of pixels at z = 0 that faces the camera, in noisy light of radiance 1.
Layers noisyWall(int width, int height, float noise) {
  Layers wall;
  wall.width = width;
  wall.height = height;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float albedo = (x / 4 + y / 4) % 2 ? 0.8f : 0.1f;
      const float light = 1.0f + noise * ((x * 7 + y * 13) % 11 - 5.0f) / 3.2f;
      wall.albedo.emplace_back(albedo);
      wall.radiance.emplace_back(albedo * light);
      wall.rest.radiance.emplace_back(albedo * light);
      wall.rest.deviation.push_back(albedo * noise);
      wall.sun.radiance.emplace_back(0.0f);
      wall.sun.deviation.push_back(0.0f);
      wall.normal.emplace_back(0.0f, 0.0f, 1.0f);
      wall.position.emplace_back(0.01f * float(x), 0.01f * float(y), 0.0f);
    }
  return wall;
}

}  // namespace

TEST_CASE("smooth light: a picture of few paths comes near one of many", "[render]") {
  const std::vector<Vec3f> many = Scene(1024).layers().radiance;
  const Layers few = Scene(8).layers();
  const double before = difference(few.radiance, many), after = difference(smoothedRadiance(few), many);
  CAPTURE(before, after);
  CHECK(after < 0.65 * before);
}

TEST_CASE("smooth light: nothing changes where nothing is uncertain", "[render]") {
  Layers layers = noisyWall(40, 30, 0.2f);
  layers.rest.deviation.assign(layers.rest.deviation.size(), 0.0f);
  CHECK(difference(smoothedRadiance(layers), layers.radiance) < 1e-7);
}

TEST_CASE("smooth light: noise goes and texture stays", "[render]") {
  const Layers wall = noisyWall(64, 48, 0.1f);
  const std::vector<Vec3f> smooth = smoothedRadiance(wall);
  double square = 0.0;
  for (std::size_t i = 0; i < smooth.size(); ++i)
    square += std::pow(smooth[i][0] / wall.albedo[i][0] - 1.0, 2.0);
  CHECK(std::sqrt(square / double(smooth.size())) < 0.02);
}

TEST_CASE("smooth light: light does not go over to another surface", "[render]") {
  // The right half is a metre behind the left one and in half as much light; in the middle a step of light on
  // one surface that is far above the noise.
  Layers wall = noisyWall(64, 48, 0.02f);
  const std::vector<float> noise = wall.rest.deviation;
  for (std::size_t i = 0; i < wall.radiance.size(); ++i) {
    const std::size_t x = i % 64, y = i / 64;
    if (x >= 32) {
      wall.position[i][2] = -1.0f;
      wall.radiance[i] *= 0.5f;
    }
    if (y >= 24) wall.radiance[i] *= 0.5f;
    wall.rest.radiance[i] = wall.radiance[i];
  }
  const std::vector<Vec3f> smooth = smoothedRadiance(wall);
  for (std::size_t i = 0; i < smooth.size(); ++i) {
    const std::size_t x = i % 64, y = i / 64;
    const double light = (x >= 32 ? 0.5 : 1.0) * (y >= 24 ? 0.5 : 1.0);
    CAPTURE(x, y);
    REQUIRE(smooth[i][0] / wall.albedo[i][0] == Approx(light).epsilon(0.05));
  }
}
