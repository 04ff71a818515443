#include "texture/shown/vector_maps.h"

#include "texture/exemplar/texel_place.h"
#include "texture/labels/coordinate_gradient.h"
#include "texture/loops/parallel.h"

#include <cmath>

namespace fluidtex::texture {
namespace {

constexpr float kLeastUp = 0.05f;  // of a normal's z

Vec3f normalAt(const Vec3f& n, const TexelGradient& gradient, float spacing, const Vec3f& stored) {
  const float up = std::max(stored.z(), kLeastUp);
  return n + gradient.s * (stored.x() / up * spacing) - gradient.t * (stored.y() / up * spacing);
}

// The tangent d with G d = (x, -y): G^T (G G^T)^-1 (x, -y).
Vec3f directionAt(const Vec3f& n, const TexelGradient& gradient, const Vec3f& stored) {
  const float ss = gradient.s.lengthSqr(), tt = gradient.t.lengthSqr(), st = gradient.s.dot(gradient.t);
  const float determinant = ss * tt - st * st;
  const float x = stored.x(), y = -stored.y(), length = std::hypot(x, y);
  Vec3f along(0.0f);
  if (determinant > 1e-6f * ss * tt) along = gradient.s * (tt * x - st * y) + gradient.t * (ss * y - st * x);
  if (!along.normalize(0.0f)) along = Vec3f(0.0f);
  return along * length + n * stored.z();
}

// Integers cannot represent 0: the middle of 8 bits is off by 1/255 in each component.
Vec3f unitOrZero(Vec3f v) {
  constexpr float kNothing = 0.02f;
  return v.normalize(kNothing) ? v : Vec3f(0.0f);
}

// Gradients estimated from the coordinates in the vertices' axes, as rows in world space.
std::vector<TexelGradient> shownGradients(const TexturedSurface& surface, const VertexGraph& graph,
                                          bool toroidal) {
  const std::vector<std::optional<Jacobian>> fitted = fittedGradients({surface, graph, toroidal});
  std::vector<TexelGradient> result(fitted.size());
  forEachIndex(fitted.size(), [&](std::uint32_t v) {
    const Vec3f d = surface.orientation[v] / float(surface.spacingAt(v)), b = rowAxis(d, surface.normals[v]);
    const Jacobian j = fitted[v].value_or(Jacobian{1.0f, 0.0f, 0.0f, 1.0f});
    result[v] = {d * j[0] + b * j[1], d * j[2] + b * j[3]};
  });
  return result;
}

}  // namespace

void lookUpVectors(const std::string& name, const ExemplarMap& map, bool toroidal, TexturedSurface& surface) {
  const TexelToImage toMap(surface, map.image);
  if (map.image.channels != 3 || map.holds == MapHolds::values)
    throw std::invalid_argument("lookUpVectors: the map must have three channels and hold vectors");
  for (const std::string& part : vectorNames(name)) surface.maps.erase(part);
  std::vector<Vec3f>& result = surface.vectors[name];
  result.resize(surface.positions.size());
  forEachIndex(result.size(), [&](std::uint32_t v) {
    const Vec3f& n = surface.normals[v];
    const auto lying = [&](const Vec2f& coordinate, const TexelGradient& gradient) {
      float c[3];
      sampleCubic(map.image, toroidal, toMap(coordinate), c);
      const Vec3f stored(2.0f * c[0] - 1.0f, 2.0f * c[1] - 1.0f, 2.0f * c[2] - 1.0f);
      return unitOrZero(map.holds == MapHolds::normals
                            ? normalAt(n, gradient, float(surface.spacingAt(v)), stored)
                            : directionAt(n, gradient, stored));
    };
    const Vec3f now = lying(surface.coordinate[v], surface.gradient[v]);
    const float weight = leftOf(surface.fading, v);
    result[v] = weight > 0.0f
                    ? unitOrZero(now * (1.0f - weight) +
                                 lying(surface.fading.coordinate[v], surface.fading.gradient[v]) * weight)
                    : now;
  });
}

void recoverGradients(bool toroidal, TexturedSurface& surface) {
  SurfaceMesh mesh;
  mesh.spacing = surface.spacing;
  mesh.positions = surface.positions;
  mesh.triangles = surface.triangles;
  const VertexGraph graph = buildVertexGraph(mesh);
  surface.gradient = shownGradients(surface, graph, toroidal);
  std::swap(surface.coordinate, surface.fading.coordinate);
  surface.fading.gradient = shownGradients(surface, graph, toroidal);
  std::swap(surface.coordinate, surface.fading.coordinate);
}

}  // namespace fluidtex::texture
