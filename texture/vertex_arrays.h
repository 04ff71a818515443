// Every array of a surface that has one entry a vertex. What checks surfaces, makes room for what is carried
// and keeps states walks these lists: a further array is a member in texture/surface.h and a line here. How
// it is carried (transport/carry.cpp, transport/onto.cpp) and its properties in a PLY (tools/ply.cpp) it has
// to say itself.
#pragma once

#include "texture/surface.h"

#include <type_traits>
#include <utility>

namespace fluidtex::texture {

// Whether an array may be empty instead.
enum class Array { needed, optional };

namespace detail {

// `Part&`, const where `Whole` is.
template <class Part, class Whole>
auto& partOf(Whole& whole) {
  return static_cast<std::conditional_t<std::is_const_v<Whole>, const Part, Part>&>(whole);
}

}  // namespace detail

// visit(array, Array) for each array of a mesh. That none is left out, the compiler sees: the names must be
// as many as the members.
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

// The same for the arrays of what vertices show.
template <class Texture, class Visit>
void forEachTextureArray(Texture& texture, const Visit& visit) {
  auto& [color, coordinate, gradient, fading, age, trust, previousPosition] =
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
}

// The same for all arrays of a finished frame's surface, further maps by name included.
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

// Whether an array has an entry for each of `count` vertices, or none where it may.
template <class Values>
bool fits(const Values& values, Array array, std::size_t count) {
  return values.size() == count || (array == Array::optional && values.empty());
}

}  // namespace fluidtex::texture
