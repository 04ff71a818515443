#include "render/tile_tracer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace fluidtex::render {
namespace {

constexpr float kFilterRadius = 0.8f;
constexpr int kMostLayers = 32;  // of see-through liquid from one scattering to the next

// Between the liquid and a solid that it touches, in diagonals of the domain: nothing but the two meshes' own
// errors.
constexpr float kMostGap = 0.03f, kLeastGap = 2e-4f;

// Dimensions of the sample points: the pixel filter, the lens, the shutter, then four a path vertex.
enum Dimension {
  kFilter = 0,
  kLens = 1,
  kShutter = 2,
  kChance = 3,
  kBase = 4,
  kCoat = 5,
  kSun = 6,
  kPerVertex = 4
};

// Weight of a sample drawn with density `pdf` where the other way of sampling would have drawn it with
// density `other`.
float powerWeight(float pdf, float other) {
  return pdf * pdf / (pdf * pdf + other * other);
}

Ray rayAt(float time, const Vec3f& origin, const Vec3f& direction) {
  Ray ray{origin, direction};
  ray.time = time;
  return ray;
}

// A direction that the smooth normal allows but that runs into the flat triangle is bent to just above it.
Vec3f above(const Vec3f& direction, const Vec3f& faceNormal) {
  constexpr float kLeastCosine = 1e-3f;
  const float cosine = direction.dot(faceNormal);
  return cosine >= kLeastCosine ? direction : normalized(direction + faceNormal * (kLeastCosine - cosine));
}

}  // namespace

PixelSum& PixelSum::operator+=(const PixelSum& other) {
  radiance += other.radiance;
  sun += other.sun;
  rest += other.rest;
  albedo += other.albedo;
  normal += other.normal;
  position += other.position;
  met += other.met;
  return *this;
}

void TileTracer::begin(int round, int paths) {
  const std::uint32_t seed =
      round == 0 ? m_world.frame : hash(m_world.frame, static_cast<std::uint32_t>(round));
  m_points.clear();
  m_points.reserve(m_tile.pixels());
  for (int y = m_tile.y0; y < m_tile.y1; ++y)
    for (int x = m_tile.x0; x < m_tile.x1; ++x) m_points.emplace_back(x, y, paths, seed);
}

void TileTracer::trace(int first, int last, std::vector<PixelSum>& sums) {
  m_sums = &sums;
  startPaths(first, last);
  for (Coherence coherence = Coherence::alike; !m_paths.rays.empty(); coherence = Coherence::scattered) {
    m_world.scene.intersect(m_paths.rays, coherence);
    advance();
    addUnblocked(m_sunLight, Coherence::alike);
    addUnblocked(m_skyLight, Coherence::scattered);
    std::swap(m_paths, m_next);
  }
}

void TileTracer::startPaths(int first, int last) {
  m_paths.clear();
  for (std::size_t pixel = 0; pixel < m_tile.pixels(); ++pixel) {
    const int column = static_cast<int>(pixel) % m_tile.width(),
              row = static_cast<int>(pixel) / m_tile.width();
    const float x = static_cast<float>(m_tile.x0 + column) + 0.5f;
    const float y = static_cast<float>(m_tile.y0 + row) + 0.5f;
    for (int sample = first; sample < last; ++sample) {
      const Vec2f offset = tentOffset(m_points[pixel].point(sample, kFilter), kFilterRadius);
      const Vec2f onLens = uniformDisc(m_points[pixel].point(sample, kLens));
      const auto [origin, direction] = m_world.camera.fromLens(x + offset[0], y + offset[1], onLens);
      const float time = m_points[pixel].point(sample, kShutter)[0];
      m_paths.add(rayAt(time, origin, direction), {.time = time,
                                                   .pixel = static_cast<std::uint16_t>(pixel),
                                                   .sample = static_cast<std::uint16_t>(sample),
                                                   .inLiquid = m_world.cameraInLiquid});
    }
  }
}

// One vertex of every path: collects what escaped, lists rays to the sun and, from the last vertices, to the
// sky, and the paths' next steps.
void TileTracer::advance() {
  m_next.clear();
  m_sunLight.clear();
  m_skyLight.clear();
  for (std::size_t i = 0; i < m_paths.rays.size(); ++i) {
    Ray& ray = m_paths.rays[i];
    Path& path = m_paths.of[i];
    bool covered = true;
    if (m_world.stage.clear)
      covered = passClear(ray, path);
    else if (m_world.stage.seeThrough)
      passCutOut(ray, path);
    if (ray.hit())
      scatter(ray, path, covered);
    else
      add(escaped(ray.direction, path), Vec3f(1.0f));
  }
}

Vec2f TileTracer::spread(const Path& path, int dimension) const {
  return m_points[path.pixel].point(path.sample, dimension + path.depth * kPerVertex);
}

// A random number for one see-through layer. The first is by far the most frequent and has a well spread
// sample; the others share out hashes.
float TileTracer::chanceOf(Path& path) const {
  const float first = spread(path, kChance)[1];
  if (path.layers++ == 0) return first;
  const std::uint32_t key = hash(hash(static_cast<std::uint32_t>(first * 0x1p24f), path.sample), path.layers);
  return static_cast<float>(key >> 8) * 0x1p-24f;
}

// Lets a ray through liquid by the chance that its alpha leaves it.
void TileTracer::passCutOut(Ray& ray, Path& path) const {
  for (path.layers = 0; path.layers < kMostLayers && ray.geometry == kLiquid;) {
    if (chanceOf(path) < liquidOpacity(m_world.stage, ray)) return;
    ray.origin = originBehind(m_world.stage, ray);
    m_world.scene.intersect({&ray, 1}, Coherence::scattered);
  }
}

// Share of light that is left after a way through the liquid.
Vec3f TileTracer::absorbed(const Vec3f& from, const Vec3f& to) const {
  const float length = (to - from).length();
  Vec3f share;
  for (int k = 0; k < 3; ++k) share[k] = std::exp(-m_world.stage.absorption[k] * length);
  return share;
}

// Takes a ray that leaves the liquid to the solid which the liquid touches there, if one is drawn. The two
// meshes cross each other: the solid may also lie between the liquid's surface and the place just behind it
// where the next ray starts.
bool TileTracer::onWetSolid(Ray& ray, const Vec3f& from) const {
  const auto distanceTo = [&](const Ray& there) {
    return there.hit() && there.geometry != kLiquid ? (hitOf(m_world.stage, there).position - from).length()
                                                    : std::numeric_limits<float>::max();
  };
  const float diagonal = m_world.stage.domainSize.length();
  Ray behind = rayAt(ray.time, originBehind(m_world.stage, ray), ray.direction);
  m_world.scene.intersect({&behind, 1}, Coherence::scattered);
  if (!(distanceTo(behind) < kMostGap * diagonal)) {
    behind.direction = -ray.direction;
    behind.geometry = kNothing;
    m_world.scene.intersect({&behind, 1}, Coherence::scattered);
    if (!(distanceTo(behind) < kLeastGap * diagonal)) return false;
    behind.direction = ray.direction;
  }
  ray = behind;
  return true;
}

// Follows a ray through the surfaces of a clear liquid, mirrored or refracted by chance, until it meets
// texture, a solid or nothing. False if it stands before the liquid untouched: there both ways are taken.
bool TileTracer::passClear(Ray& ray, Path& path) const {
  const Stage& stage = m_world.stage;
  for (; path.layers < kMostLayers; m_world.scene.intersect({&ray, 1}, Coherence::scattered)) {
    if (!ray.hit()) return true;
    const Hit hit = hitOf(stage, ray);
    if (path.inLiquid) path.throughput *= absorbed(ray.origin, hit.position);
    if (ray.geometry != kLiquid) return true;
    const bool touches = touchesSolid(stage, ray);
    // Between a liquid and what it wets there is no surface that refracts.
    if (touches && !hit.inside && path.inLiquid) {
      ++path.layers;
      ray = rayAt(ray.time, originBehind(stage, ray), ray.direction);
      continue;
    }
    if (touches && hit.inside && onWetSolid(ray, hit.position)) return true;
    const float chance = chanceOf(path);
    const float opacity = liquidOpacity(stage, ray);
    if (chance < opacity) return true;
    path.inLiquid = hit.inside;
    if (path.untouched && !hit.inside) return false;

    const ShadingPoint at = shadingPoint(stage, ray, false);
    const float ratio = hit.inside ? stage.index : 1.0f / stage.index;
    const Boundary boundary = boundaryAt(-ray.direction.dot(at.normal), ratio);
    path.pdf = 0.0f;
    if (chance < opacity + (1.0f - opacity) * boundary.reflected) {
      const Vec3f mirrored = ray.direction - at.normal * (2.0f * ray.direction.dot(at.normal));
      ray = rayAt(ray.time, at.origin, above(mirrored, at.faceNormal));
    } else {
      const Vec3f direction = refracted(ray.direction, at.normal, ratio, boundary);
      ray = rayAt(ray.time, originBehind(stage, ray), above(direction, -at.faceNormal));
      path.inLiquid = !hit.inside;
    }
  }
  ray.geometry = kNothing;  // lost between its surfaces
  path.throughput = Vec3f(0.0f);
  return true;
}

void TileTracer::scatter(const Ray& ray, Path path, bool covered) {
  ShadingPoint point = shadingPoint(m_world.stage, ray, covered);
  if (point.opacity < 1.0f) {
    add(escaped(ray.direction, path), Vec3f(1.0f - point.opacity));
    path.throughput *= point.opacity;
    if (point.opacity <= 0.0f) return;
  }
  if (const Vec3f glow = path.throughput * point.material.emission; largest(glow) > 0.0f)
    add({glow, path.matt ? glow : Vec3f(0.0f), &PixelSum::rest, path.pixel, false}, Vec3f(1.0f));
  // Only the first vertex has its coat: seen by way of another surface it would cost noise and not be
  // noticed.
  if (!path.untouched || path.inLiquid) point.material.gloss = 0.0f;
  if (path.untouched && !point.material.clear) {
    PixelSum& sum = (*m_sums)[path.pixel];
    sum.albedo += point.material.base * path.throughput;
    sum.normal += point.normal;
    sum.position += point.position;
    sum.met += 1.0f;
  }

  const Axes axes(point.normal);
  const Vec3f wo = axes.local(-ray.direction);
  lightFromSun(point, axes, wo, path);
  if (point.material.gloss > 0.0f)
    follow(sampleCoat(point.material, wo, spread(path, kCoat)), point, axes, path, false);
  if (point.material.clear)
    enterLiquid(ray, point, path);
  else
    follow(sampleBase(point.material, wo, spread(path, kBase)), point, axes, path,
           path.untouched || path.matt);
}

// The path's next step in a sampled direction.
void TileTracer::follow(const LobeSample& sample, const ShadingPoint& point, const Axes& axes, Path path,
                        bool matt) {
  if (!(sample.lobe.pdf > 0.0f)) return;
  path.throughput *= sample.lobe.value * (1.0f / sample.lobe.pdf);
  path.pdf = sample.lobe.pdf;
  path.untouched = false;
  path.matt = matt;
  path.layers = 0;
  ++path.depth;
  goOn(point.origin, above(axes.world(sample.wi), point.faceNormal), path);
}

void TileTracer::enterLiquid(const Ray& ray, const ShadingPoint& point, Path path) {
  const float cosine = -ray.direction.dot(point.normal), ratio = 1.0f / m_world.stage.index;
  const Vec3f direction = refracted(ray.direction, point.normal, ratio, boundaryAt(cosine, ratio));
  path.throughput *= 1.0f - coatFresnel(point.material, cosine);
  path.pdf = 0.0f;
  path.inLiquid = true;
  goOn(originBehind(m_world.stage, ray), above(direction, -point.faceNormal), path);
}

// From the last vertices on, only what comes straight from the sky counts.
void TileTracer::goOn(const Vec3f& origin, const Vec3f& direction, const Path& path) {
  if (!(largest(path.throughput) > 0.0f)) return;
  if (path.depth <= m_world.options.bounces)
    m_next.add(rayAt(path.time, origin, direction), path);
  else
    m_skyLight.add(rayAt(path.time, origin, direction), escaped(direction, path));
}

void TileTracer::lightFromSun(const ShadingPoint& point, const Axes& axes, const Vec3f& wo,
                              const Path& path) {
  const Sky& sky = m_world.sky;
  const Vec3f direction = Axes(sky.sunDirection).world(uniformCone(spread(path, kSun), sky.sunCosine));
  const Vec3f wi = axes.local(direction), arrives = sky.sunColor * path.throughput;
  // Paths that are refracted on their way to the sun do not count it, so that this way counts whole.
  const auto from = [&](const Lobe& lobe) {
    if (!(lobe.pdf > 0.0f)) return Vec3f(0.0f);
    return arrives * lobe.value * (path.inLiquid ? 1.0f : powerWeight(sky.sunPdf, lobe.pdf));
  };
  const Vec3f base = from(evaluateBase(point.material, wo, wi));
  const Vec3f light = base + from(evaluateCoat(point.material, wo, wi));
  if (!(largest(light) > 0.0f)) return;
  const Vec3f matt = path.untouched || path.matt ? base : Vec3f(0.0f);
  m_sunLight.add(rayAt(path.time, point.origin, direction),
                 {light, matt, path.untouched ? &PixelSum::sun : &PixelSum::rest, path.pixel, path.inLiquid});
}

// Light that a path brings back when its ray leaves the scene. The camera does not see the sun's disc.
TileTracer::PixelLight TileTracer::escaped(const Vec3f& direction, const Path& path) const {
  const Sky& sky = m_world.sky;
  Vec3f radiance = sky.radiance(direction);
  if (path.pdf > 0.0f && sky.inSun(direction))
    radiance += sky.sunRadiance * powerWeight(path.pdf, sky.sunPdf);
  radiance *= path.throughput;
  return {radiance, path.matt ? radiance : Vec3f(0.0f), &PixelSum::rest, path.pixel, path.inLiquid};
}

// Share of light that gets along a ray through see-through liquid. Light goes straight through the surface of
// clear liquid: what it would gather into caustics is spread evenly.
Vec3f TileTracer::transmitted(Ray ray, bool inLiquid) const {
  const Stage& stage = m_world.stage;
  // Radiance inside counts by the square of the index, which paths leave out since they come out again: what
  // comes in from outside along a straight ray is spread over all directions inside.
  Vec3f share(inLiquid ? 1.0f / (stage.index * stage.index) : 1.0f);
  for (int layer = 0; layer < kMostLayers; ++layer) {
    m_world.scene.intersect({&ray, 1}, Coherence::scattered);
    if (!ray.hit()) return share;
    // Between a clear liquid and what it wets there is neither a surface nor texture.
    const bool wet = stage.clear && touchesSolid(stage, ray);
    if (stage.clear && ray.geometry == kLiquid) {
      const Hit hit = hitOf(stage, ray);
      if (inLiquid) share *= absorbed(ray.origin, hit.position);
      if (!wet) share *= 1.0f - boundaryAt(-ray.direction.dot(hit.faceNormal), 1.0f / stage.index).reflected;
      inLiquid = !hit.inside;
    }
    if (!wet) share *= 1.0f - std::clamp(liquidOpacity(stage, ray), 0.0f, 1.0f);
    if (!(largest(share) > 0.0f)) return Vec3f(0.0f);
    ray.origin = originBehind(stage, ray);
  }
  return Vec3f(0.0f);
}

void TileTracer::add(const PixelLight& light, const Vec3f& share) {
  PixelSum& sum = (*m_sums)[light.pixel];
  sum.radiance += light.radiance * share;
  sum.*light.part += light.matt * share;
}

void TileTracer::addUnblocked(const Rays<PixelLight>& light, Coherence coherence) {
  if (m_world.stage.seeThrough || m_world.stage.clear) {
    for (std::size_t i = 0; i < light.rays.size(); ++i)
      add(light.of[i], transmitted(light.rays[i], light.of[i].inLiquid));
    return;
  }
  m_blocked.resize(light.rays.size());
  m_world.scene.occluded(light.rays, m_blocked, coherence);
  for (std::size_t i = 0; i < light.rays.size(); ++i)
    if (!m_blocked[i]) add(light.of[i], Vec3f(1.0f));
}

}  // namespace fluidtex::render
