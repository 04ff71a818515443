#include "texture/shown/plain.h"

#include <stdexcept>

namespace fluidtex::texture {
namespace {

const Vec4f kPale(0.42f, 0.55f, 0.62f, 1.0f);  // linear

TexturedSurface meshOf(Surface surface) {
  TexturedSurface result;
  if (surface.empty()) return result;
  SurfaceMesh& mesh = surface.levels.front();
  if (mesh.orientation.size() != mesh.positions.size())
    throw std::invalid_argument("a surface without orientation cannot be textured");
  result.spacing = mesh.spacing;
  takeMesh(mesh, result);
  return result;
}

}  // namespace

void takeMesh(SurfaceMesh& mesh, TexturedSurface& result) {
  result.positions = std::move(mesh.positions);
  result.normals = std::move(mesh.normals);
  result.orientation = std::move(mesh.orientation);
  result.triangles = std::move(mesh.triangles);
  result.scale = std::move(mesh.scale);
  if (!mesh.guidance.empty()) result.maps[kGuidance] = std::move(mesh.guidance);
  if (!mesh.foam.empty()) result.maps[kFoam] = std::move(mesh.foam);
}

TexturedSurface untextured(Surface surface, const Carried& carried) {
  TexturedSurface result = meshOf(std::move(surface));
  const std::size_t count = result.positions.size();
  result.color.assign(count, kPale);
  result.coordinate.assign(count, Vec2f(0.0f));
  result.gradient.resize(count);
  result.fading = noFading(count);
  result.age.assign(count, 0.0f);
  result.trust = carried.empty() ? std::vector<float>(count, 0.0f) : carried.trust;
  result.previousPosition = carried.empty() ? result.positions : carried.previousPosition;
  return result;
}

TexturedSurface advected(Surface surface, const Carried& carried, double secondsSinceLast) {
  TexturedSurface result = meshOf(std::move(surface));
  if (carried.trust.size() != result.positions.size())
    throw std::invalid_argument("advected: carried arrays must have one entry per vertex");
  result.color = carried.color;
  result.coordinate = carried.coordinate;
  result.gradient = carried.gradient;
  result.fading = noFading(result.positions.size());
  result.age = carried.age;
  for (float& age : result.age) age += float(secondsSinceLast);
  result.trust = carried.trust;
  result.previousPosition = carried.previousPosition;
  return result;
}

}  // namespace fluidtex::texture
