// Path tracing with next-event estimation of the sun, combined with sampling of the material by the power
// heuristic [Veach97]. The picture is cut into tiles; inside one, all paths advance together one step at a
// time, so that rays of a kind reach Embree in one go.
#include "render/path_tracer.h"

#include "render/bump.h"
#include "render/camera.h"
#include "render/embree_scene.h"
#include "render/sampling.h"
#include "render/shading_point.h"
#include "render/sky.h"
#include "render/surroundings.h"

#include <tbb/parallel_for.h>

#include <mutex>
#include <stdexcept>

namespace fluidtex::render {
namespace {

constexpr int kTile = 16;           // pixels across
constexpr int kSamplesAtOnce = 16;  // of each pixel of a tile
constexpr float kFilterRadius = 0.8f;
constexpr int kMostLayers = 32;  // of see-through liquid along one ray

// Dimensions of the sample points: the pixel filter, then three a path vertex.
enum Dimension { kFilter = 0, kChoice = 1, kDirection = 2, kSun = 3, kPerVertex = 3 };

struct Path {
  Vec3f throughput;
  float pdf;  // with which its direction was drawn
  std::uint16_t pixel, sample;
};

struct PixelLight {
  Vec3f radiance;  // that arrives if nothing is in the way
  std::uint16_t pixel;
};

struct World {
  Stage stage;
  EmbreeScene scene;
  Sky sky;
  CameraRays camera;
  Options options;
  std::uint32_t frame;
};

// Weight of a sample drawn with density `pdf` where the other way of sampling would have drawn it with
// density `other`.
float powerWeight(float pdf, float other) {
  return pdf * pdf / (pdf * pdf + other * other);
}

class TileTracer {
 public:
  TileTracer(const World& world, int x0, int y0, int x1, int y1)
      : m_world(world), m_x0(x0), m_y0(y0), m_width(x1 - x0), m_height(y1 - y0) {
    m_sum.resize(static_cast<std::size_t>(m_width) * m_height, Vec3f(0.0f));
    m_points.reserve(m_sum.size());
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x) m_points.emplace_back(x, y, world.options.samples, world.frame);
  }

  void trace(int firstSample, int lastSample) {
    startPaths(firstSample, lastSample);
    for (int depth = 0; depth <= m_world.options.bounces; ++depth) {
      m_world.scene.intersect(m_rays, depth == 0 ? Coherence::alike : Coherence::scattered);
      advance(depth);
      addUnblocked(m_sunRays, m_sunLight, Coherence::alike);
    }
    // From the last vertices on, only what comes straight from the sky counts.
    std::vector<PixelLight> skyLight(m_rays.size());
    for (std::size_t i = 0; i < m_rays.size(); ++i)
      skyLight[i] = {escaped(m_rays[i].direction, m_paths[i]), m_paths[i].pixel};
    addUnblocked(m_rays, skyLight, Coherence::scattered);
  }

  void store(Picture& picture) const {
    const float scale = 1.0f / static_cast<float>(m_world.options.samples);
    for (int y = 0; y < m_height; ++y)
      for (int x = 0; x < m_width; ++x) {
        const Vec3f color = m_sum[static_cast<std::size_t>(y) * m_width + x] * scale;
        float* out = &picture.rgb[(static_cast<std::size_t>(m_y0 + y) * picture.width + m_x0 + x) * 3];
        for (int k = 0; k < 3; ++k) out[k] = color[k];
      }
  }

 private:
  void startPaths(int firstSample, int lastSample) {
    m_rays.clear();
    m_paths.clear();
    for (std::size_t pixel = 0; pixel < m_sum.size(); ++pixel) {
      const int column = static_cast<int>(pixel) % m_width, row = static_cast<int>(pixel) / m_width;
      const float x = static_cast<float>(m_x0 + column) + 0.5f, y = static_cast<float>(m_y0 + row) + 0.5f;
      for (int sample = firstSample; sample < lastSample; ++sample) {
        const Vec2f offset = tentOffset(m_points[pixel].point(sample, kFilter), kFilterRadius);
        m_rays.push_back({m_world.camera.origin, m_world.camera.direction(x + offset[0], y + offset[1])});
        m_paths.push_back(
            {Vec3f(1.0f), 0.0f, static_cast<std::uint16_t>(pixel), static_cast<std::uint16_t>(sample)});
      }
    }
  }

  // Light that a path brings back when its ray leaves the scene. The camera does not see the sun's disc.
  Vec3f escaped(const Vec3f& direction, const Path& path) const {
    const Sky& sky = m_world.sky;
    Vec3f radiance = sky.radiance(direction);
    if (path.pdf > 0.0f && sky.inSun(direction))
      radiance += sky.sunRadiance * powerWeight(path.pdf, sky.sunPdf);
    return radiance * path.throughput;
  }

  // Lets rays through liquid by the chance that its alpha leaves them.
  void passThrough(Ray& ray, const Path& path, int depth) const {
    // The first layer is by far the most frequent and has a well spread sample; the others share out hashes.
    float chance = m_points[path.pixel].point(path.sample, kChoice + depth * kPerVertex)[1];
    std::uint32_t key = hash(static_cast<std::uint32_t>(chance * 0x1p24f), path.sample);
    for (int layer = 0; layer < kMostLayers && ray.geometry == kLiquid; ++layer) {
      if (chance < liquidOpacity(m_world.stage, ray)) return;
      ray.origin = originBehind(m_world.stage, ray);
      m_world.scene.intersect({&ray, 1}, Coherence::scattered);
      key = hash(key, static_cast<std::uint32_t>(layer));
      chance = static_cast<float>(key >> 8) * 0x1p-24f;
    }
  }

  // Share of light that gets along a ray through see-through liquid.
  float transmitted(Ray ray) const {
    float share = 1.0f;
    for (int layer = 0; layer < kMostLayers; ++layer) {
      m_world.scene.intersect({&ray, 1}, Coherence::scattered);
      if (!ray.hit()) return share;
      share *= 1.0f - std::clamp(liquidOpacity(m_world.stage, ray), 0.0f, 1.0f);
      if (share <= 0.0f) return 0.0f;
      ray.origin = originBehind(m_world.stage, ray);
    }
    return 0.0f;
  }

  void addUnblocked(const std::vector<Ray>& rays, const std::vector<PixelLight>& light, Coherence coherence) {
    if (m_world.stage.seeThrough) {
      for (std::size_t i = 0; i < rays.size(); ++i)
        m_sum[light[i].pixel] += light[i].radiance * transmitted(rays[i]);
      return;
    }
    m_blocked.resize(rays.size());
    m_world.scene.occluded(rays, m_blocked, coherence);
    for (std::size_t i = 0; i < rays.size(); ++i)
      if (!m_blocked[i]) m_sum[light[i].pixel] += light[i].radiance;
  }

  // One vertex of every path: collects what escaped, lists rays to the sun, and replaces rays and paths by
  // the next step's.
  void advance(int depth) {
    m_sunRays.clear();
    m_sunLight.clear();
    std::size_t kept = 0;
    for (std::size_t i = 0; i < m_rays.size(); ++i) {
      if (m_world.stage.seeThrough) passThrough(m_rays[i], m_paths[i], depth);
      if (!m_rays[i].hit()) {
        m_sum[m_paths[i].pixel] += escaped(m_rays[i].direction, m_paths[i]);
      } else if (Ray next; scatter(depth, m_rays[i], m_paths[i], next)) {
        m_rays[kept] = next;
        m_paths[kept++] = m_paths[i];
      }
    }
    m_rays.resize(kept);
    m_paths.resize(kept);
  }

  // False where the path ends.
  bool scatter(int depth, const Ray& ray, Path& path, Ray& next) {
    const PixelSamples& points = m_points[path.pixel];
    const int dimension = depth * kPerVertex;
    ShadingPoint point = shadingPoint(m_world.stage, ray);
    if (point.opacity < 1.0f) {
      m_sum[path.pixel] += escaped(ray.direction, path) * (1.0f - point.opacity);
      path.throughput *= point.opacity;
      if (point.opacity <= 0.0f) return false;
    }
    // Only the first vertex has its coat: seen by way of another surface it would cost noise and not be
    // noticed.
    if (depth > 0) point.material.gloss = 0.0f;
    const Axes axes(point.normal);
    const Vec3f wo = axes.local(-ray.direction);

    lightFromSun(points.point(path.sample, kSun + dimension), point, axes, wo, path);

    const float choice = points.point(path.sample, kChoice + dimension)[0];
    const MaterialSample sample =
        sampleMaterial(point.material, wo, choice, points.point(path.sample, kDirection + dimension));
    if (!(sample.scattering.pdf > 0.0f)) return false;
    path.throughput *= sample.scattering.value * (1.0f / sample.scattering.pdf);
    path.pdf = sample.scattering.pdf;
    next.origin = point.origin;
    next.direction = above(axes.world(sample.wi), point.faceNormal);
    return true;
  }

  // A direction that the smooth normal allows but that runs into the flat triangle is bent to just above it.
  static Vec3f above(const Vec3f& direction, const Vec3f& faceNormal) {
    constexpr float kLeastCosine = 1e-3f;
    const float cosine = direction.dot(faceNormal);
    return cosine >= kLeastCosine ? direction : normalized(direction + faceNormal * (kLeastCosine - cosine));
  }

  void lightFromSun(const Vec2f& u, const ShadingPoint& point, const Axes& axes, const Vec3f& wo,
                    const Path& path) {
    const Sky& sky = m_world.sky;
    const Vec3f direction = Axes(sky.sunDirection).world(uniformCone(u, sky.sunCosine));
    const Scattering scattering = evaluate(point.material, wo, axes.local(direction));
    if (!(scattering.pdf > 0.0f)) return;
    const float weight = powerWeight(sky.sunPdf, scattering.pdf);
    const Vec3f light = sky.sunColor * scattering.value * path.throughput * weight;
    if (!(largest(light) > 0.0f)) return;
    m_sunRays.push_back({point.origin, direction});
    m_sunLight.push_back({light, path.pixel});
  }

  const World& m_world;
  int m_x0, m_y0, m_width, m_height;
  std::vector<PixelSamples> m_points;
  std::vector<Vec3f> m_sum;
  std::vector<Ray> m_rays;
  std::vector<Path> m_paths;  // of m_rays
  std::vector<Ray> m_sunRays;
  std::vector<PixelLight> m_sunLight;  // of m_sunRays
  std::vector<std::uint8_t> m_blocked;
};

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
  const auto checkCorners = [](const std::vector<texture::Vec3I>& triangles, std::size_t count) {
    for (const texture::Vec3I& t : triangles)
      if (t[0] >= count || t[1] >= count || t[2] >= count)
        throw std::invalid_argument("a triangle has a corner that is not in its mesh");
  };
  checkCorners(surface.triangles, vertices);
  for (const Solid& solid : solids) checkCorners(solid.triangles, solid.positions.size());
}

void buildWorld(World& world, const texture::TexturedSurface& surface, const std::vector<Solid>& solids,
                const Options& options, const View& view) {
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
  stage.seeThrough = view.seeThrough || std::any_of(surface.color.begin(), surface.color.end(),
                                                    [](const Vec4f& color) { return color[3] < 1.0f; });

  world.scene.add(surface.positions, surface.triangles);
  for (const Mesh& mesh : stage.meshes) world.scene.add(mesh.positions, mesh.triangles);
  world.scene.commit();
}

}  // namespace

Picture traceRadiance(const texture::TexturedSurface& surface, const std::vector<Solid>& solids,
                      const Options& options, const View& view, const std::function<void(double)>& progress) {
  checkInput(surface, solids, options);
  World world;
  buildWorld(world, surface, solids, options, view);

  Picture picture;
  picture.width = options.width;
  picture.height = options.height;
  picture.rgb.resize(static_cast<std::size_t>(options.width) * options.height * 3);

  const int across = (options.width + kTile - 1) / kTile, down = (options.height + kTile - 1) / kTile;
  std::mutex reporting;
  int done = 0;
  tbb::parallel_for(0, across * down, [&](int tile) {
    const int x0 = tile % across * kTile, y0 = tile / across * kTile;
    TileTracer tracer(world, x0, y0, std::min(x0 + kTile, options.width),
                      std::min(y0 + kTile, options.height));
    for (int sample = 0; sample < options.samples; sample += kSamplesAtOnce)
      tracer.trace(sample, std::min(sample + kSamplesAtOnce, options.samples));
    tracer.store(picture);
    if (progress) {
      const std::lock_guard lock(reporting);
      progress(static_cast<double>(++done) / (across * down));
    }
  });
  return picture;
}

}  // namespace fluidtex::render
