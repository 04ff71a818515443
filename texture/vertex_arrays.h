// Lists of all per-vertex arrays of a surface, for code that checks, resizes, transports or saves them. A new
// array needs a member in texture/surface.h and a line here. Its transport (transport/carry.cpp,
// transport/onto.cpp) and its PLY properties (tools/formats/ply.cpp) have to be written by hand.
#pragma once

#include "texture/surface.h"

#include <type_traits>
#include <utility>

namespace fluidtex::texture {

// Whether an array may be empty.
enum class Array { needed, optional };

namespace detail {

// `Part&`, const where `Whole` is const.
template <class Part, class Whole>
auto& partOf(Whole& whole) {
  return static_cast<std::conditional_t<std::is_const_v<Whole>, const Part, Part>&>(whole);
}

}  // namespace detail

// visit(array, Array) for each array of a mesh. The structured binding fails to compile if a member is
// missing.
template <class Mesh, class Visit>
void forEachMeshArray(Mesh& mesh, const Visit& visit) {
  auto& [spacing, positions, normals, triangles, orientation, scale, guidance, foam] =
      detail::partOf<SurfaceMesh>(mesh);
  visit(positions, Array::needed);
  visit(normals, Array::needed);
  visit(orientation, Array::needed);
  visit(scale, Array::optional);
  visit(guidance, Array::optional);
  visit(foam, Array::optional);
}

// The same for the arrays of a VertexTexture.
template <class Texture, class Visit>
void forEachTextureArray(Texture& texture, const Visit& visit) {
  auto& [color, coordinate, gradient, fading, age, trust, previousPosition, original, rest, secondRest] =
      detail::partOf<VertexTexture>(texture);
  auto& [formerCoordinate, formerGradient, weight, speed] = fading;
  visit(color, Array::needed);
  visit(coordinate, Array::needed);
  visit(gradient, Array::needed);
  visit(formerCoordinate, Array::needed);
  visit(formerGradient, Array::needed);
  visit(weight, Array::needed);
  visit(speed, Array::needed);
  visit(age, Array::needed);
  visit(trust, Array::needed);
  visit(previousPosition, Array::needed);
  visit(original, Array::optional);
  visit(rest, Array::optional);
  visit(secondRest, Array::optional);
}

// The same for all arrays of a textured surface, further maps by name included.
template <class Surface, class Visit>
void forEachVertexArray(Surface& surface, const Visit& visit) {
  static_assert(sizeof(TexturedSurface) == sizeof(SurfaceMesh) + sizeof(VertexTexture) +
                                               sizeof(surface.velocity) + sizeof(surface.contact) +
                                               sizeof(surface.maps) + sizeof(surface.vectors) +
                                               2 * sizeof(int),
                "a member of TexturedSurface is missing here");
  forEachMeshArray(surface, visit);
  forEachTextureArray(surface, visit);
  visit(surface.velocity, Array::needed);
  visit(surface.contact, Array::needed);
  for (auto& [name, values] : surface.maps) visit(values, Array::needed);
  for (auto& [name, values] : surface.vectors) visit(values, Array::needed);
}

// Whether an array has `count` entries, or is empty where it may be.
template <class Values>
bool fits(const Values& values, Array array, std::size_t count) {
  return values.size() == count || (array == Array::optional && values.empty());
}

}  // namespace fluidtex::texture
