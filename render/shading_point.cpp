// Based on: Hanika, Hacking the shadow terminator, Ray Tracing Gems II, 2021.
#include "render/shading_point.h"

#include "render/surroundings.h"

namespace fluidtex::render {
namespace {

// Rays start this far off the surface, in diagonals of the domain: well above rounding, well below anything
// visible.
constexpr float kStartOff = 2e-5f;

// Colour of a liquid that carries no texture.
constexpr float kPlain[3] = {0.25f, 0.42f, 0.55f};

// Seconds from the frame's own moment.
float awayAt(float shutter, float time) {
  return shutter * (time - 0.5f);
}

struct Corners {
  Vec3f p[3];
  Vec3f weights;
  Vec3f position;
  Vec3f faceNormal;  // unit, counter-clockwise side
};

Corners cornersOf(const Stage& stage, const Ray& ray) {
  const bool liquid = ray.geometry == kLiquid;
  const auto& positions = liquid ? stage.liquid->positions : stage.meshes[ray.geometry - 1].positions;
  const auto& triangles = liquid ? stage.liquid->triangles : stage.meshes[ray.geometry - 1].triangles;
  const texture::Vec3I& triangle = triangles[ray.triangle];
  Corners c;
  for (int k = 0; k < 3; ++k) c.p[k] = positions[triangle[k]];
  if (liquid && stage.shutter > 0.0f)
    for (int k = 0; k < 3; ++k)
      c.p[k] += stage.liquid->velocity[triangle[k]] * awayAt(stage.shutter, ray.time);
  c.weights = Vec3f(1.0f - ray.u - ray.v, ray.u, ray.v);
  c.position = c.p[0] * c.weights[0] + c.p[1] * c.weights[1] + c.p[2] * c.weights[2];
  c.faceNormal = normalized((c.p[1] - c.p[0]).cross(c.p[2] - c.p[0]));
  return c;
}

// The smooth normal turned as far towards the viewer as is needed for it to be seen from there.
Vec3f facing(const Vec3f& normal, const Vec3f& toViewer) {
  constexpr float kLeastCosine = 0.02f;
  const float cosine = normal.dot(toViewer);
  if (cosine >= kLeastCosine) return normal;
  return normalized(normal + toViewer * (kLeastCosine - cosine));
}

}  // namespace

Vec4f liquidColor(const Stage& stage, std::uint32_t triangle, const Vec3f& weights) {
  const texture::TexturedSurface& liquid = *stage.liquid;
  if (stage.colorBetween) {
    if (const auto color = stage.colorBetween(triangle, weights)) return *color;
  }
  if (liquid.color.empty()) return Vec4f(kPlain[0], kPlain[1], kPlain[2], 1.0f);
  // Weighted by alpha: what colour a see-through corner has does not matter.
  const texture::Vec3I& corner = liquid.triangles[triangle];
  Vec4f sum(0.0f);
  for (int k = 0; k < 3; ++k) {
    const Vec4f& color = liquid.color[corner[k]];
    const float weight = weights[k] * color[3];
    sum += Vec4f(color[0] * weight, color[1] * weight, color[2] * weight, weight);
  }
  const float scale = sum[3] > 0.0f ? 1.0f / sum[3] : 0.0f;
  return Vec4f(sum[0] * scale, sum[1] * scale, sum[2] * scale, sum[3]);
}

float liquidOpacity(const Stage& stage, const Ray& ray) {
  if (ray.geometry != kLiquid) return 1.0f;
  if (stage.cover <= 0.0f) return 0.0f;
  return stage.cover * liquidColor(stage, ray.triangle, Vec3f(1.0f - ray.u - ray.v, ray.u, ray.v))[3];
}

Hit hitOf(const Stage& stage, const Ray& ray) {
  const Corners c = cornersOf(stage, ray);
  const bool inside = c.faceNormal.dot(ray.direction) > 0.0f;
  return {c.position, inside ? -c.faceNormal : c.faceNormal, inside};
}

bool touchesSolid(const Stage& stage, const Ray& ray) {
  const std::vector<std::uint8_t>& contact = stage.liquid->contact;
  if (ray.geometry != kLiquid || contact.empty()) return false;
  const texture::Vec3I& corner = stage.liquid->triangles[ray.triangle];
  return contact[corner[0]] && contact[corner[1]] && contact[corner[2]];
}

ShadingPoint shadingPoint(const Stage& stage, const Ray& ray, bool covered) {
  const Corners c = cornersOf(stage, ray);
  const float diagonal = stage.domainSize.length();
  const float side = c.faceNormal.dot(ray.direction) > 0.0f ? -1.0f : 1.0f;

  ShadingPoint point;
  point.inside = ray.geometry == kLiquid && side < 0.0f;
  point.position = c.position;
  point.faceNormal = c.faceNormal * side;
  point.normal = point.faceNormal;
  Vec3f lift(0.0f);
  if (ray.geometry == kLiquid) {
    const texture::TexturedSurface& liquid = *stage.liquid;
    const Vec4f color = liquidColor(stage, ray.triangle, c.weights);
    for (int k = 0; k < 3; ++k) point.material.base[k] = std::clamp(color[k], 0.0f, 1.0f);
    point.material.gloss = stage.gloss;
    point.material.roughness = stage.roughness;
    point.material.index = stage.index;
    point.material.clear = stage.clear && !covered;
    if (point.material.clear) point.material.gloss = 1.0f;
    if (!stage.emission.empty()) {
      const texture::Vec3I& corner = liquid.triangles[ray.triangle];
      for (int k = 0; k < 3; ++k) point.material.emission += stage.emission[corner[k]] * c.weights[k];
    }
    if (!liquid.normals.empty()) {
      const texture::Vec3I& triangle = liquid.triangles[ray.triangle];
      const std::vector<Vec3f>& shown = stage.bumped.empty() ? liquid.normals : stage.bumped;
      Vec3f smooth(0.0f);
      for (int k = 0; k < 3; ++k) {
        const Vec3f n = liquid.normals[triangle[k]] * side;
        smooth += shown[triangle[k]] * (side * c.weights[k]);
        lift -= n * (c.weights[k] * std::min(0.0f, (c.position - c.p[k]).dot(n)));
      }
      smooth = normalized(smooth);
      if (lengthSquared(smooth) > 0.0f) point.normal = facing(smooth, -ray.direction);
    }
  } else {
    const Mesh& mesh = stage.meshes[ray.geometry - 1];
    point.material.base = mesh.color;
    if (mesh.kind == MeshKind::ground)
      point.opacity =
          groundOpacity((c.position - stage.domainOrigin - stage.domainSize * 0.5f).length() / diagonal);
  }
  point.origin = c.position + lift + point.faceNormal * (kStartOff * diagonal);
  return point;
}

Vec3f originBehind(const Stage& stage, const Ray& ray) {
  const Corners c = cornersOf(stage, ray);
  const float side = c.faceNormal.dot(ray.direction) > 0.0f ? 1.0f : -1.0f;
  return c.position + c.faceNormal * (side * kStartOff * stage.domainSize.length());
}

}  // namespace fluidtex::render
