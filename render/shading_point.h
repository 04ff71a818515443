// Data for shading at the point where a ray hits a surface.
#pragma once

#include "render/embree_scene.h"
#include "render/material.h"
#include "render/options.h"
#include "render/render.h"

namespace fluidtex::render {

// The geometry of a picture, in the order in which meshes were added to the Embree scene: the liquid first.
struct Stage {
  const texture::TexturedSurface* liquid = nullptr;
  std::vector<Mesh> meshes;
  Vec3f domainSize{1.0f}, domainOrigin{0.0f};
  float shutter = 0.0f;                   // seconds, in which the liquid moves by its velocity; 0: it stands
  float gloss = 1.0f, roughness = 0.05f;  // of the liquid's coat
  bool clear = false;                     // the liquid is: its texture lies on it as far as its alpha says
  float cover = 1.0f;                     // how far it hides the clear liquid where its alpha is 1
  float index = 1.45f;                    // of refraction
  Vec3f absorption{0.0f};                 // 1/m, inside a clear liquid
  std::vector<Vec3f> emission;            // #V, linear radiance; empty: none
  std::vector<Vec3f> bumped;              // normals to shade by; empty: the liquid's own
  bool seeThrough = false;                // some of the liquid has alpha < 1
  ColorBetween colorBetween;              // see View
};

inline constexpr std::uint32_t kLiquid = 0;  // the liquid's geometry number; mesh i has i + 1

struct ShadingPoint {
  Vec3f position;
  Vec3f origin;      // start of secondary rays, offset from the surface, see below
  Vec3f faceNormal;  // unit, of the triangle, on the side the ray came from
  Vec3f normal;      // unit, smooth, with bumps; always on the side the ray came from
  Material material;
  float opacity = 1.0f;  // 0: invisible
  bool inside = false;   // of the liquid, as the ray that came to its surface was
};

// Linear colour and alpha of the liquid inside a triangle, at barycentric weights.
Vec4f liquidColor(const Stage& stage, std::uint32_t triangle, const Vec3f& weights);

// At the hit only: 1 except on liquid with alpha below 1.
float liquidOpacity(const Stage& stage, const Ray& ray);

// Where a ray has hit a triangle.
struct Hit {
  Vec3f position;
  Vec3f faceNormal;     // unit, on the side the ray came from
  bool inside = false;  // that side is the inside, of a closed mesh
};

// Precondition: `ray` has hit something.
Hit hitOf(const Stage& stage, const Ray& ray);

// Whether the liquid touches a solid in the triangle that the ray has hit.
bool touchesSolid(const Stage& stage, const Ray& ray);

// Precondition: `ray` has hit something. covered: whether a clear liquid is covered by its texture there.
//
// `origin` lies on the smooth surface that the vertex normals suggest, where that is in front of the flat
// triangle [Hanika21], so that facets cast no shadow on themselves.
ShadingPoint shadingPoint(const Stage& stage, const Ray& ray, bool covered = true);

// Start of the ray that continues behind the surface.
Vec3f originBehind(const Stage& stage, const Ray& ray);

}  // namespace fluidtex::render
