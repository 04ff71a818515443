// Traces the paths of one tile of a picture.
//
// All paths of a tile advance together one step at a time, so that rays of a kind reach Embree in one go.
// Path tracing with next-event estimation of the sun, combined with sampling of the material by the power
// heuristic [Veach97].
#pragma once

#include "render/camera.h"
#include "render/embree_scene.h"
#include "render/layers.h"
#include "render/sampling.h"
#include "render/shading_point.h"
#include "render/sky.h"

#include <vector>

namespace fluidtex::render {

struct World {
  texture::TexturedSurface displaced;  // the liquid, where it is
  Stage stage;
  EmbreeScene scene;
  Sky sky;
  CameraRays camera;
  Options options;
  std::uint32_t frame;
  bool cameraInLiquid = false;  // in clear liquid
};

// Pixels x0 <= x < x1, y0 <= y < y1.
struct Tile {
  int x0, y0, x1, y1;
  int width() const { return x1 - x0; }
  std::size_t pixels() const { return static_cast<std::size_t>(width()) * (y1 - y0); }
};

// Of one pixel, summed over its paths: see Layers.
struct PixelSum {
  Vec3f radiance{0.0f}, sun{0.0f}, rest{0.0f};
  Vec3f albedo{0.0f}, normal{0.0f}, position{0.0f};
  float met = 0.0f;  // paths that have met a matt surface first, of which position and normal are

  PixelSum& operator+=(const PixelSum& other);
};

class TileTracer {
 public:
  TileTracer(const World& world, const Tile& tile) : m_world(world), m_tile(tile) {}

  // Begins a round of `paths` for each pixel, independent of other rounds.
  void begin(int round, int paths);

  // Traces paths first..last-1 of the round and adds them to `sums`, one a pixel, row by row.
  void trace(int first, int last, std::vector<PixelSum>& sums);

 private:
  struct Path {
    Vec3f throughput{1.0f};
    float time = 0.0f;  // of its rays
    float pdf = 0.0f;   // with which its direction was drawn; 0: it was mirrored or refracted, or has none
    std::uint16_t pixel = 0, sample = 0;
    std::uint8_t depth = 0;   // surfaces that have scattered it
    std::uint8_t layers = 0;  // see-through ones that it has met
    bool untouched = true;    // no surface has scattered it
    bool matt = false;        // the first that has was matt
    bool inLiquid = false;    // it is in clear liquid
  };

  // Arrives if nothing is in the way.
  struct PixelLight {
    Vec3f radiance;
    Vec3f matt;             // the part of it that comes by way of a matt surface first
    Vec3f PixelSum::*part;  // which that part counts to
    std::uint16_t pixel;
    bool inLiquid;  // where its ray begins
  };

  // Rays and what they are of.
  template <class Of>
  struct Rays {
    std::vector<Ray> rays;
    std::vector<Of> of;
    void clear() {
      rays.clear();
      of.clear();
    }
    void add(const Ray& ray, const Of& what) {
      rays.push_back(ray);
      of.push_back(what);
    }
  };

  void startPaths(int first, int last);
  void advance();
  void passCutOut(Ray& ray, Path& path) const;
  bool passClear(Ray& ray, Path& path) const;
  bool onWetSolid(Ray& ray, const Vec3f& from) const;
  void scatter(const Ray& ray, Path path, bool covered);
  void enterLiquid(const Ray& ray, const ShadingPoint& point, Path path);
  void goOn(const Vec3f& origin, const Vec3f& direction, const Path& path);
  void follow(const LobeSample& sample, const ShadingPoint& point, const Axes& axes, Path path, bool matt);
  void lightFromSun(const ShadingPoint& point, const Axes& axes, const Vec3f& wo, const Path& path);
  PixelLight escaped(const Vec3f& direction, const Path& path) const;
  Vec3f absorbed(const Vec3f& from, const Vec3f& to) const;
  Vec3f transmitted(Ray ray, bool inLiquid) const;
  void add(const PixelLight& light, const Vec3f& share);
  void addUnblocked(const Rays<PixelLight>& light, Coherence coherence);
  Vec2f spread(const Path& path, int dimension) const;
  float chanceOf(Path& path) const;

  const World& m_world;
  Tile m_tile;
  std::vector<PixelSamples> m_points;
  std::vector<PixelSum>* m_sums = nullptr;
  Rays<Path> m_paths, m_next;
  Rays<PixelLight> m_sunLight;  // from the sun, if it can be seen
  Rays<PixelLight> m_skyLight;  // from the sky, at the ends of paths
  std::vector<std::uint8_t> m_blocked;
};

}  // namespace fluidtex::render
