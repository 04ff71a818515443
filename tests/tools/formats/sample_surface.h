// A textured tetrahedron with every array filled by values that differ.
#pragma once

#include "texture/surface.h"

inline fluidtex::texture::TexturedSurface sampleSurface() {
  using namespace fluidtex::texture;
  TexturedSurface s;
  s.spacing = 0.01;
  s.exemplarWidth = 8;
  s.exemplarHeight = 4;
  s.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  s.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  for (int v = 0; v < 4; ++v) {
    const float f = static_cast<float>(v);
    s.normals.emplace_back(0.0f, 0.6f, 0.8f);
    s.orientation.emplace_back(1.0f, 0.0f, f);
    s.color.emplace_back(0.5f, 0.5f, 0.5f, 0.25f);
    s.coordinate.emplace_back(2.0f + f, f);
    s.gradient.push_back({{f, 1, 2}, {3, f, 5}});
    s.fading.coordinate.emplace_back(f, 3.0f - f);
    s.fading.gradient.push_back({{7, f, 2}, {f, 8, 9}});
    s.fading.weight.push_back(0.3f * f);
    s.fading.speed.push_back(2.0f + f);
    s.age.push_back(0.1f * f);
    s.trust.push_back(0.2f * f);
    s.previousPosition.emplace_back(f, f, f);
    s.velocity.emplace_back(-f, 0.0f, f);
    s.contact.push_back(static_cast<std::uint8_t>(v % 2));
    s.maps["height"].push_back(10.0f + f);
  }
  return s;
}
