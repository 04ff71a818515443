// Everything that shading wants to know about the place where a ray met something.
#pragma once

#include "render/embree_scene.h"
#include "render/material.h"
#include "render/options.h"
#include "render/render.h"

namespace fluidtex::render {

// What a picture is made of, in the order in which the meshes were added to the Embree scene: the liquid
// first.
struct Stage {
  const texture::TexturedSurface* liquid = nullptr;
  std::vector<Mesh> meshes;
  Vec3f domainSize{1.0f};
  float gloss = 1.0f, roughness = 0.05f;  // of the liquid's coat
  std::vector<Vec3f> bumped;              // normals to shade by; empty: the liquid's own
  bool seeThrough = false;                // some of the liquid has alpha < 1
  ColorBetween colorBetween;              // see View
};

inline constexpr std::uint32_t kLiquid = 0;  // the liquid's geometry number; mesh i has i + 1

struct ShadingPoint {
  Vec3f position;
  Vec3f origin;      // where rays that leave the point start: free of the surface, see below
  Vec3f faceNormal;  // unit, of the triangle, on the side the ray came from
  Vec3f normal;      // unit, smooth, with bumps; always on the side the ray came from
  Material material;
  float opacity = 1.0f;  // 0: not there at all
};

// Linear colour and alpha of the liquid inside a triangle, at barycentric weights.
Vec4f liquidColor(const Stage& stage, std::uint32_t triangle, const Vec3f& weights);

// Of the hit alone: 1 except on liquid with alpha below 1.
float liquidOpacity(const Stage& stage, const Ray& ray);

// `ray` has hit something. `origin` lies on the smooth surface that the vertex normals suggest, where that is
// in front of the flat triangle [Hanika21], so that facets throw no shadow on themselves.
ShadingPoint shadingPoint(const Stage& stage, const Ray& ray);

// Where a ray that passes through the surface goes on.
Vec3f originBehind(const Stage& stage, const Ray& ray);

}  // namespace fluidtex::render
