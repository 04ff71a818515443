// The picture is cut into tiles, each traced by itself until its noise is below the bound [Dammertz et al., A
// hierarchical automatic stopping condition for Monte Carlo global illumination, 2010].
#include "render/path_tracer.h"

#include "render/black_body.h"
#include "render/bump.h"
#include "render/develop.h"
#include "render/displace.h"
#include "render/surroundings.h"
#include "render/tile_tracer.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <stdexcept>

namespace fluidtex::render {
namespace {

constexpr int kTile = 16;           // pixels across
constexpr int kSamplesAtOnce = 16;  // of each pixel of a tile
constexpr int kFirstRound = 16;     // paths a pixel before a tile's noise is looked at

void checkInput(const texture::TexturedSurface& surface, const std::vector<Solid>& solids,
                const Options& options) {
  const std::size_t vertices = surface.positions.size();
  if (options.width < 1 || options.height < 1)
    throw std::invalid_argument("a picture needs at least one pixel");
  if (options.samples < 1 || options.samples > 65536)
    throw std::invalid_argument("samples a pixel must lie between 1 and 65536");
  if (options.bounces < 0) throw std::invalid_argument("the number of bounces must not be negative");
  if (!(options.roughness >= 0.0)) throw std::invalid_argument("the coat's roughness must not be negative");
  if (!surface.color.empty() && surface.color.size() != vertices)
    throw std::invalid_argument("the surface's colours do not match its vertices");
  if (!surface.normals.empty() && surface.normals.size() != vertices)
    throw std::invalid_argument("the surface's normals do not match its vertices");
  if (!surface.contact.empty() && surface.contact.size() != vertices)
    throw std::invalid_argument("what the surface touches does not match its vertices");
  if (!surface.velocity.empty() && surface.velocity.size() != vertices)
    throw std::invalid_argument("the surface's velocities do not match its vertices");
  const auto checkCorners = [](const std::vector<texture::Vec3I>& triangles, std::size_t count) {
    for (const texture::Vec3I& t : triangles)
      if (t[0] >= count || t[1] >= count || t[2] >= count)
        throw std::invalid_argument("a triangle has a corner that is not in its mesh");
  };
  checkCorners(surface.triangles, vertices);
  for (const Solid& solid : solids) checkCorners(solid.triangles, solid.positions.size());
}

// #V, linear radiance; empty where the surface lacks the map that says how hot it is.
std::vector<Vec3f> glowOf(const texture::TexturedSurface& surface, const LiquidMaterial& lava) {
  const std::size_t count = surface.positions.size();
  const float scale = static_cast<float>(lava.glow) / luminance(blackBody(lava.hottest));
  const auto at = [&](double heat) {
    return blackBody(lava.coldest + (lava.hottest - lava.coldest) * heat) * scale;
  };
  if (lava.heat.empty()) return std::vector<Vec3f>(count, at(1.0));
  const auto map = surface.maps.find(lava.heat);
  if (map == surface.maps.end() || map->second.size() != count) return {};
  constexpr int kSteps = 1023;
  std::vector<Vec3f> table(kSteps + 1);
  for (int i = 0; i <= kSteps; ++i) table[i] = at(double(i) / kSteps);
  std::vector<Vec3f> glow(count);
  for (std::size_t v = 0; v < count; ++v)
    glow[v] = table[static_cast<int>(std::lround(std::clamp(map->second[v], 0.0f, 1.0f) * kSteps))];
  return glow;
}

// Whether the first surface of the liquid above a place is seen from inside.
bool isInLiquid(const World& world, const Vec3f& place) {
  Ray up{place, Vec3f(0.0f, 0.0f, 1.0f)};
  constexpr int kMostSolids = 64;
  for (int n = 0; n < kMostSolids; ++n) {
    world.scene.intersect({&up, 1}, Coherence::scattered);
    if (!up.hit()) return false;
    if (up.geometry == kLiquid) return hitOf(world.stage, up).inside;
    up.origin = originBehind(world.stage, up);
  }
  return false;
}

void buildWorld(World& world, const texture::TexturedSurface& original, const std::vector<Solid>& solids,
                const Options& options, const View& view) {
  const bool moves = options.displacement.any() && original.maps.contains(options.displacement.map);
  if (moves) world.displaced = displaced(original, options.displacement);
  const texture::TexturedSurface& surface = moves ? world.displaced : original;
  world.options = options;
  world.frame = static_cast<std::uint32_t>(view.frame);
  world.sky = makeSky(options.light);
  world.camera = makeCamera(options.camera, options.width, options.height, view.progress);

  Stage& stage = world.stage;
  stage.liquid = &surface;
  if (options.bump.any() && hasMap(surface, options.bump))
    stage.bumped = bumpedNormals(surface, options.bump);
  stage.colorBetween = view.colorBetween;
  stage.meshes = surroundingMeshes(options.surroundings, view.domainSize);
  for (Mesh& mesh : stage.meshes)
    for (Vec3f& x : mesh.positions) x += Vec3f(view.domainOrigin);
  for (const Solid& solid : solids)
    stage.meshes.push_back({MeshKind::matt, solid.positions, solid.triangles, Vec3f(solid.color)});
  stage.domainSize = Vec3f(view.domainSize);
  stage.domainOrigin = Vec3f(view.domainOrigin);
  stage.gloss = std::clamp(static_cast<float>(options.gloss), 0.0f, 1.0f);
  stage.roughness = std::clamp(static_cast<float>(options.roughness), 0.005f, 1.0f);
  stage.clear = options.material.kind == MaterialKind::water;
  if (stage.clear) {
    stage.cover = view.textured && !surface.color.empty() ? static_cast<float>(options.material.cover) : 0.0f;
    stage.index = static_cast<float>(options.material.index);
    stage.absorption = Vec3f(options.material.absorption);
  }
  if (options.material.glows()) stage.emission = glowOf(surface, options.material);
  stage.seeThrough = view.seeThrough || std::any_of(surface.color.begin(), surface.color.end(),
                                                    [](const Vec4f& color) { return color[3] < 1.0f; });

  if (options.camera.shutter > 0.0 && !surface.velocity.empty()) {
    stage.shutter = static_cast<float>(options.camera.shutter / view.frameRate);
    std::vector<Vec3f> before = surface.positions, after = surface.positions;
    for (std::size_t v = 0; v < before.size(); ++v) {
      before[v] -= surface.velocity[v] * (0.5f * stage.shutter);
      after[v] += surface.velocity[v] * (0.5f * stage.shutter);
    }
    world.scene.addMoving(before, after, surface.triangles);
  } else {
    world.scene.add(surface.positions, surface.triangles);
  }
  for (const Mesh& mesh : stage.meshes) world.scene.add(mesh.positions, mesh.triangles);
  world.scene.commit();
  world.cameraInLiquid = stage.clear && isInLiquid(world, world.camera.origin);
}

// Sums of two parts of a tile's paths, which are independent or nearly so, and how many paths they are of.
struct Halves {
  std::vector<PixelSum> first, second;
  int firstPaths = 0, secondPaths = 0;

  int paths() const { return firstPaths + secondPaths; }

  // The standard error of the mean of all, from a value's means in both halves.
  float errorOf(float meanOfFirst, float meanOfSecond) const {
    const float weight = std::sqrt(static_cast<float>(firstPaths) * static_cast<float>(secondPaths)) /
                         static_cast<float>(paths());
    return (meanOfFirst - meanOfSecond) * weight;
  }
};

// Root mean square over a tile's pixels and colours: standard error of what is displayed, 0..1.
float displayedError(const Halves& halves, double exposure) {
  double sum = 0.0;
  for (std::size_t i = 0; i < halves.first.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const float a = halves.first[i].radiance[k] / static_cast<float>(halves.firstPaths);
      const float b = halves.second[i].radiance[k] / static_cast<float>(halves.secondPaths);
      const float error = halves.errorOf(displayed(a, exposure), displayed(b, exposure));
      sum += static_cast<double>(error) * error;
    }
  return static_cast<float>(std::sqrt(sum / (3.0 * static_cast<double>(halves.first.size()))));
}

// Rounds of paths, each as many as all before, until the tile's noise is below its bound or the paths are
// spent.
Halves traceTile(const World& world, const Tile& tile) {
  const Options& options = world.options;
  TileTracer tracer(world, tile);
  Halves halves;
  halves.first.resize(tile.pixels());
  halves.second.resize(tile.pixels());
  const auto trace = [&](int from, int to, std::vector<PixelSum>& sums) {
    for (int sample = from; sample < to; sample += kSamplesAtOnce)
      tracer.trace(sample, std::min(sample + kSamplesAtOnce, to), sums);
  };

  const int paths = std::min(options.samples, kFirstRound);
  tracer.begin(0, paths);
  halves.firstPaths = paths / 2;
  halves.secondPaths = paths - paths / 2;
  trace(0, halves.firstPaths, halves.first);
  trace(halves.firstPaths, paths, halves.second);
  for (int round = 1; halves.paths() < options.samples; ++round) {
    if (options.noise > 0.0 && displayedError(halves, options.exposure) <= options.noise) break;
    for (std::size_t i = 0; i < halves.first.size(); ++i) halves.first[i] += halves.second[i];
    halves.second.assign(tile.pixels(), {});
    halves.firstPaths = halves.paths();
    halves.secondPaths = std::min(halves.firstPaths, options.samples - halves.firstPaths);
    tracer.begin(round, halves.secondPaths);
    trace(0, halves.secondPaths, halves.second);
  }
  return halves;
}

// With one path alone nothing is known of the error: as large as the value.
float deviationOf(const Halves& halves, const Vec3f& sumOfFirst, const Vec3f& sumOfSecond) {
  const float second = luminance(sumOfSecond) / static_cast<float>(halves.secondPaths);
  if (halves.firstPaths == 0) return second;
  return std::abs(halves.errorOf(luminance(sumOfFirst) / static_cast<float>(halves.firstPaths), second));
}

void store(const Halves& halves, const Tile& tile, Layers& layers) {
  const float scale = 1.0f / static_cast<float>(halves.paths());
  for (std::size_t i = 0; i < halves.first.size(); ++i) {
    const PixelSum &a = halves.first[i], &b = halves.second[i];
    PixelSum all = a;
    all += b;
    const std::size_t x = tile.x0 + i % tile.width(), y = tile.y0 + i / tile.width(),
                      at = y * layers.width + x;
    layers.radiance[at] = all.radiance * scale;
    layers.sun.radiance[at] = all.sun * scale;
    layers.sun.deviation[at] = deviationOf(halves, a.sun, b.sun);
    layers.rest.radiance[at] = all.rest * scale;
    layers.rest.deviation[at] = deviationOf(halves, a.rest, b.rest);
    layers.albedo[at] = all.albedo * scale;
    layers.normal[at] = all.normal * scale;
    layers.position[at] = all.met > 0.0f ? all.position * (1.0f / all.met) : Vec3f(0.0f);
  }
}

Layers emptyLayers(int width, int height) {
  const std::size_t pixels = static_cast<std::size_t>(width) * height;
  Layers layers;
  layers.width = width;
  layers.height = height;
  for (std::vector<Vec3f>* values : {&layers.radiance, &layers.sun.radiance, &layers.rest.radiance,
                                     &layers.albedo, &layers.normal, &layers.position})
    values->resize(pixels);
  layers.sun.deviation.resize(pixels);
  layers.rest.deviation.resize(pixels);
  return layers;
}

}  // namespace

Layers traceLayers(const texture::TexturedSurface& surface, const std::vector<Solid>& solids,
                   const Options& options, const View& view, const std::function<void(double)>& progress) {
  checkInput(surface, solids, options);
  World world;
  buildWorld(world, surface, solids, options, view);

  Layers layers = emptyLayers(options.width, options.height);
  const int across = (options.width + kTile - 1) / kTile, down = (options.height + kTile - 1) / kTile;
  std::mutex reporting;
  int done = 0;
  tbb::parallel_for(0, across * down, [&](int number) {
    const int x0 = number % across * kTile, y0 = number / across * kTile;
    const Tile tile{x0, y0, std::min(x0 + kTile, options.width), std::min(y0 + kTile, options.height)};
    store(traceTile(world, tile), tile, layers);
    if (progress) {
      const std::lock_guard lock(reporting);
      progress(static_cast<double>(++done) / (across * down));
    }
  });
  return layers;
}

}  // namespace fluidtex::render
