#include "render/bump.h"

#include "texture/map_names.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace fluidtex::render {
namespace {

constexpr float kLeastUp = 0.05f;  // of a normal along the surface's own

// Per vertex, per metre.
std::vector<Vec3f> gradientOf(const std::vector<float>& values, const texture::TexturedSurface& surface) {
  std::vector<Vec3f> sum(values.size(), Vec3f(0.0f));
  std::vector<float> area(values.size(), 0.0f);
  for (const texture::Vec3I& t : surface.triangles) {
    const Vec3f& p = surface.positions[t[0]];
    const Vec3f a = surface.positions[t[1]] - p, b = surface.positions[t[2]] - p;
    const Vec3f normal = a.cross(b);
    const float twice = normal.length();
    if (!(twice > 0.0f)) continue;
    // Times twice the area.
    const Vec3f slope =
        normal.cross(a * (values[t[2]] - values[t[0]]) - b * (values[t[1]] - values[t[0]])) / twice;
    for (int k = 0; k < 3; ++k) {
      sum[t[k]] += slope;
      area[t[k]] += twice;
    }
  }
  for (std::size_t v = 0; v < sum.size(); ++v)
    if (area[v] > 0.0f) sum[v] /= area[v];
  return sum;
}

// The vectors of a map, also where they have been read from a file, part by part; nothing where it has none.
std::vector<Vec3f> vectorsOf(const std::string& map, const texture::TexturedSurface& surface) {
  if (const auto found = surface.vectors.find(map); found != surface.vectors.end()) return found->second;
  std::vector<Vec3f> result;
  const std::vector<std::string> names = texture::vectorNames(map);
  for (int k = 0; k < 3; ++k) {
    const auto part = surface.maps.find(names[k]);
    if (part == surface.maps.end()) return {};
    result.resize(part->second.size());
    for (std::size_t v = 0; v < result.size(); ++v) result[v][k] = part->second[v];
  }
  return result;
}

}  // namespace

bool hasMap(const texture::TexturedSurface& surface, const Bump& bump) {
  return surface.maps.contains(bump.map) || !vectorsOf(bump.map, surface).empty();
}

std::vector<Vec3f> bumpedNormals(const texture::TexturedSurface& surface, const Bump& bump) {
  const std::size_t count = surface.positions.size();
  if (surface.normals.size() != count) throw std::invalid_argument("bumps need a surface with normals");
  const float height = static_cast<float>(bump.height);
  std::vector<Vec3f> result(count);
  if (const auto values = surface.maps.find(bump.map); values != surface.maps.end()) {
    if (values->second.size() != count || !(surface.spacing > 0.0))
      throw std::invalid_argument("bumps need a surface with a spacing, and a value at each vertex");
    const std::vector<Vec3f> gradient = gradientOf(values->second, surface);
    for (std::size_t v = 0; v < count; ++v) {
      const Vec3f& n = surface.normals[v];
      const Vec3f slope =
          gradient[v] * (height * static_cast<float>(surface.spacingAt(static_cast<std::uint32_t>(v))));
      result[v] = normalized(n - (slope - n * slope.dot(n)));
    }
    return result;
  }
  const std::vector<Vec3f> vectors = vectorsOf(bump.map, surface);
  if (vectors.size() != count)
    throw std::invalid_argument("the surface has no map \"" + bump.map +
                                "\" of one number or of normals, which its bumps are made from");
  for (std::size_t v = 0; v < count; ++v) {
    const Vec3f& n = surface.normals[v];
    const float up = vectors[v].dot(n);
    result[v] = normalized(n + (vectors[v] - n * up) * (height / std::max(up, kLeastUp)));
  }
  return result;
}

}  // namespace fluidtex::render
