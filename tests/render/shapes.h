// Closed forms as meshes, and a scene with nothing but even light.
#pragma once

#include "render/path_tracer.h"
#include "render/render.h"

#include <cmath>
#include <map>
#include <utility>

namespace fluidtex::render::shapes {

using texture::Vec3f;
using texture::Vec3I;
using texture::Vec4f;

// A sphere of 20 * 4^levels triangles with its exact normals, in one colour.
inline texture::TexturedSurface sphere(const Vec3f& center, float radius, int levels, const Vec4f& color) {
  const float g = 0.5f * (1.0f + std::sqrt(5.0f));
  std::vector<Vec3f> p{{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                       {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  std::vector<Vec3I> t{{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                       {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                       {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [place, isNew] =
          middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(p.size()));
      if (isNew) p.push_back((p[a] / p[a].length() + p[b] / p[b].length()) * 0.5f);
      return place->second;
    };
    std::vector<Vec3I> finer;
    for (const Vec3I& f : t) {
      const std::uint32_t a = middle(f[0], f[1]), b = middle(f[1], f[2]), c = middle(f[2], f[0]);
      finer.insert(finer.end(), {{f[0], a, c}, {f[1], b, a}, {f[2], c, b}, {a, b, c}});
    }
    t = finer;
  }
  texture::TexturedSurface surface;
  for (const Vec3f& q : p) {
    surface.normals.push_back(q / q.length());
    surface.positions.push_back(center + surface.normals.back() * radius);
    surface.color.push_back(color);
  }
  surface.triangles = t;
  return surface;
}

inline void append(texture::TexturedSurface& surface, const texture::TexturedSurface& more) {
  const auto first = static_cast<std::uint32_t>(surface.positions.size());
  surface.positions.insert(surface.positions.end(), more.positions.begin(), more.positions.end());
  surface.normals.insert(surface.normals.end(), more.normals.begin(), more.normals.end());
  surface.color.insert(surface.color.end(), more.color.begin(), more.color.end());
  for (const Vec3I& t : more.triangles)
    surface.triangles.emplace_back(t[0] + first, t[1] + first, t[2] + first);
}

// The square [low, high]^2 at height z, facing up.
inline Solid square(float low, float high, float z, const Vec3d& color) {
  return {{{low, low, z}, {high, low, z}, {high, high, z}, {low, high, z}}, {{0, 1, 2}, {0, 2, 3}}, color};
}

// A small picture in a white sky of radiance 1, without sun and surroundings, coat off.
inline Options evenLight(int width, int height, int samples) {
  Options options;
  options.width = width;
  options.height = height;
  options.samples = samples;
  options.noise = 0.0;
  options.gloss = 0.0;
  options.light.sunColor = Vec3d(0.0);
  options.light.skyColor = options.light.horizonColor = Vec3d(1.0);
  options.surroundings.ground = options.surroundings.tank = false;
  return options;
}

inline View unitView() {
  View view;
  view.domainSize = Vec3d(1.0);
  return view;
}

// All light, as it was traced.
inline Picture traceRadiance(const texture::TexturedSurface& surface, const std::vector<Solid>& solids,
                             const Options& options, const View& view) {
  const Layers layers = traceLayers(surface, solids, options, view);
  Picture picture{layers.width, layers.height, {}};
  for (const Vec3f& value : layers.radiance)
    picture.rgb.insert(picture.rgb.end(), {value[0], value[1], value[2]});
  return picture;
}

inline Vec3f pixel(const Picture& picture, int x, int y) {
  const float* p = &picture.rgb[(static_cast<std::size_t>(y) * picture.width + x) * 3];
  return {p[0], p[1], p[2]};
}

}  // namespace fluidtex::render::shapes
