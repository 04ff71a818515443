#include "texture/shown/plain.h"

#include <stdexcept>

namespace fluidtex::texture {
namespace {

const Vec4f kPale(0.42f, 0.55f, 0.62f, 1.0f);  // linear

TexturedSurface untexturedMesh(Surface surface) {
  TexturedSurface result;
  if (surface.empty()) return result;
  SurfaceMesh& mesh = surface.levels.front();
  if (mesh.orientation.size() != mesh.positions.size())
    throw std::invalid_argument("a surface without orientation cannot be textured");
  static_cast<SurfaceMesh&>(result) = std::move(mesh);
  return result;
}

}  // namespace

TexturedSurface untextured(Surface surface, const Carried& carried) {
  TexturedSurface result = untexturedMesh(std::move(surface));
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
  TexturedSurface result = untexturedMesh(std::move(surface));
  if (carried.trust.size() != result.positions.size())
    throw std::invalid_argument("advected: carried arrays must have one entry per vertex");
  static_cast<VertexTexture&>(result) = carried;
  result.fading = noFading(result.positions.size());
  for (float& age : result.age) age += float(secondsSinceLast);
  return result;
}

}  // namespace fluidtex::texture
