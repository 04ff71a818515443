// A sheet that shows an exemplar, for tests of what is measured on it.
#pragma once

#include "tests/texture/exemplar/sample_images.h"
#include "tests/texture/mesh/closed_meshes.h"
#include "texture/exemplar/image.h"

#include <cmath>
#include <functional>

namespace fluidtex::testing {

inline constexpr int kAcross = 96;  // squares of the sheet's sides

// Where in the exemplar a vertex at (x, y), texels, comes from.
using Layout = std::function<Vec2f(const Vec2f&)>;

// A ball of radius 1 that shows nothing yet.
inline TexturedSurface bareBall(int subdivisions) {
  TexturedSurface ball;
  const SurfaceMesh mesh = sphereMesh(subdivisions);
  ball.positions = ball.normals = mesh.positions;
  ball.triangles = mesh.triangles;
  ball.spacing = mesh.spacing;
  return ball;
}

// A thin level sheet whose vertices show the exemplar at their place on it. On its rim, where it is no sheet,
// the surface counts as new, unless all is.
inline TexturedSurface sheet(const Image& color, const Layout& layout, bool known = true) {
  const SurfaceMesh mesh = boxMesh({0, 0, 0}, {kAcross, kAcross, 4}, {kAcross, kAcross, 4});
  TexturedSurface surface;
  surface.spacing = 1.0;
  surface.positions = surface.previousPosition = mesh.positions;
  surface.triangles = mesh.triangles;
  surface.exemplarWidth = color.width;
  surface.exemplarHeight = color.height;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const bool level = std::abs(mesh.normals[v].z()) > 0.9f;
    const Vec3f n = level ? mesh.normals[v] : Vec3f(0, 0, mesh.positions[v].z() > 2.0f ? 1.0f : -1.0f);
    const Vec3f d(1, 0, 0), b = rowAxis(d, n);
    surface.normals.push_back(n);
    surface.orientation.push_back(d);
    surface.trust.push_back(level && known ? 1.0f : 0.0f);
    const Vec2f texel = layout(Vec2f(mesh.positions[v].dot(d), mesh.positions[v].dot(b)));
    surface.coordinate.push_back(texel);
    Vec4f shown;
    sampleCubic(color, true, texel, shown.asPointer());
    surface.color.push_back(shown);
  }
  surface.age.assign(surface.positions.size(), 0.0f);
  surface.gradient.resize(surface.positions.size());
  return surface;
}

inline Vec2f asItIs(const Vec2f& l) {
  return l;
}

// Between the exemplar's texels, as on any surface.
inline Vec2f turned(const Vec2f& l) {
  return {0.8f * l[0] - 0.6f * l[1] + 0.37f, 0.6f * l[0] + 0.8f * l[1] + 0.21f};
}

// The exemplar cut into blocks of `size` texels, each from a place of its own.
inline Layout blocks(int size, int exemplar) {
  return [=](const Vec2f& l) {
    const auto i = std::int64_t(std::floor((l[0] + 1000.0f) / float(size)));
    const auto j = std::int64_t(std::floor((l[1] + 1000.0f) / float(size)));
    const std::uint64_t block = std::uint64_t(i * 4096 + j) * 2;
    return l + Vec2f(float(exemplar * randomUnit(9, block)), float(exemplar * randomUnit(9, block + 1)));
  };
}

}  // namespace fluidtex::testing
