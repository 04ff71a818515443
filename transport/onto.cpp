#include "transport/onto.h"

#include "texture/loops/parallel.h"
#include "texture/orientation/tangent.h"
#include "transport/closest_point.h"
#include "transport/cubic_directions.h"
#include "transport/trust.h"

#include <stdexcept>

namespace fluidtex::transport {
namespace {

using texture::forEachIndex;

std::vector<Vec3f> normalsOf(const std::vector<Vec3f>& positions, const std::vector<Vec3I>& triangles) {
  std::vector<Vec3f> normals(positions.size(), Vec3f(0.0f));
  for (const Vec3I& t : triangles) {
    for (int i = 0; i < 3; ++i) {
      if (t[i] >= positions.size())
        throw std::invalid_argument("transport onto a mesh: a triangle has a vertex that does not exist");
    }
    const Vec3f& a = positions[t[0]];
    const Vec3f area = (positions[t[1]] - a).cross(positions[t[2]] - a);
    for (int i = 0; i < 3; ++i) normals[t[i]] += area;
  }
  for (Vec3f& n : normals) {
    if (!n.normalize(0.0f)) n = Vec3f(0.0f, 0.0f, 1.0f);
  }
  return normals;
}

// A vector attached to the surface: mean over the corners whose vector is close to the nearest corner's, as
// others belong to another patch; parallel transported to the normal `to`. Length 1, or 0.
Vec3f vectorAt(const std::vector<Vec3f>& values, const Landing& landing, const Vec3f& to) {
  const Vec3f &nearest = values[landing.nearestVertex()], &from = landing.normal;
  Vec3f mean(0.0f);
  for (int i = 0; i < 3; ++i) {
    const Vec3f& value = values[landing.corners[i]];
    if (value.dot(nearest) > 0.5f) mean += value * landing.point.weight[i];
  }
  if (!mean.normalize(1e-6f)) mean = nearest;
  if (from.dot(to) <= -0.9f) return mean;
  const float up = from.dot(mean);
  Vec3f result = texture::turnedTangent(mean - from * up, from, to) + to * up;
  return result.normalize(1e-6f) ? result : Vec3f(0.0f);
}

}  // namespace

TexturedSurface onto(const TexturedSurface& surface, std::vector<Vec3f> positions,
                     std::vector<Vec3I> triangles, int symmetry) {
  TexturedSurface result;
  result.normals = normalsOf(positions, triangles);
  result.positions = std::move(positions);
  result.triangles = std::move(triangles);
  result.spacing = surface.spacing;
  result.exemplarWidth = surface.exemplarWidth;
  result.exemplarHeight = surface.exemplarHeight;
  const std::size_t count = result.positions.size();
  result.orientation = texture::referenceVectors(result.normals);
  texture::clearTexture(result);
  if (!surface.scale.empty()) result.scale.assign(count, 1.0f);
  if (!surface.guidance.empty()) result.guidance.assign(count, 0.0f);
  if (!surface.foam.empty()) result.foam.assign(count, 0.0f);
  if (!surface.original.empty()) result.original.assign(count, 0);
  for (const auto& [name, values] : surface.maps) result.maps[name].assign(count, 0.0f);
  for (const auto& [name, values] : surface.vectors) result.vectors[name].assign(count, Vec3f(0.0f));
  if (surface.empty() || surface.triangles.empty()) return result;

  const ClosestPoint closest(surface.positions, surface.triangles);
  const std::vector<Vec3f> slopes = angleSlopes(surface, symmetry);
  std::vector<Landing> landings(count);
  forEachIndex(count, [&](std::uint32_t v) {
    const Vec3f& normal = result.normals[v];
    const Landing& landing = landings[v] =
        landingAt(surface, closest.nearest(Vec3d(result.positions[v]), normal, kOtherSide * surface.spacing));
    const Texel texel =
        texelAt(surface, surface.coordinate, surface.gradient, landing, Mat3d::identity(), normal);
    result.coordinate[v] = texel.coordinate;
    result.gradient[v] = texel.gradient;
    pickUpFading(surface, landing, Mat3d::identity(), normal, v, result.fading);
    result.color[v] = colorAt(surface, landing);
    result.orientation[v] =
        texture::tangentUnit(directionAt(surface, slopes, landing, symmetry), normal, result.orientation[v]);
    result.age[v] = valueAt(surface.age, landing);
    result.trust[v] = valueAt(surface.trust, landing) *
                      landingTrust(landing, surface.spacingAt(landing.nearestVertex()), normal);
    // Displacement of the closest point, so that a vertex off the surface keeps its distance.
    const Vec3f before = valueAt(surface.previousPosition, landing);
    result.previousPosition[v] += before - Vec3f(landing.point.position);
    result.velocity[v] = valueAt(surface.velocity, landing);
    if (!surface.scale.empty()) result.scale[v] = valueAt(surface.scale, landing);
    if (!surface.guidance.empty()) result.guidance[v] = valueAt(surface.guidance, landing);
    if (!surface.foam.empty()) result.foam[v] = valueAt(surface.foam, landing);
    if (!surface.original.empty()) result.original[v] = surface.original[landing.nearestVertex()];
    result.contact[v] = surface.contact[landing.nearestVertex()];
  });
  for (auto& [name, values] : result.maps) {
    const std::vector<float>& from = surface.maps.at(name);
    forEachIndex(count, [&, &to = values](std::uint32_t v) { to[v] = valueAt(from, landings[v]); });
  }
  for (auto& [name, values] : result.vectors) {
    const std::vector<Vec3f>& from = surface.vectors.at(name);
    forEachIndex(count, [&, &to = values](std::uint32_t v) {
      to[v] = vectorAt(from, landings[v], result.normals[v]);
    });
  }
  return result;
}

}  // namespace fluidtex::transport
