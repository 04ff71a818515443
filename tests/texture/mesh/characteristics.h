// The topology of a closed mesh.
#pragma once

#include "texture/mesh/editable_mesh.h"

#include <map>

namespace fluidtex::testing {

// Euler characteristic of each component, as a sorted multiset: characteristic -> how many have it.
inline std::map<long, int> characteristics(std::size_t vertices,
                                           const std::vector<texture::Vec3I>& triangles) {
  const std::vector<std::uint32_t> component = texture::components(vertices, triangles);
  std::map<std::uint32_t, long> twice;  // 2 V - T = 2 (V - E + T) where 2 E = 3 T
  for (std::uint32_t root : component) twice[root] += 2;
  for (const texture::Vec3I& t : triangles) --twice[component[t[0]]];
  std::map<long, int> result;
  for (const auto& [root, value] : twice) ++result[value / 2];
  return result;
}

}  // namespace fluidtex::testing
