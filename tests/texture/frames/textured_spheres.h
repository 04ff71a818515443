// Oriented spheres, and what a textured one hands on, for tests of frames.
#pragma once

#include "tests/texture/mesh/closed_meshes.h"
#include "texture/options.h"
#include "texture/orientation/orient.h"

namespace fluidtex::testing {

using namespace fluidtex::texture;

inline SynthesisOptions smallOptions() {
  SynthesisOptions options;
  options.windows = {17, 9};
  options.firstIterations = {3, 3};
  options.laterIterations = {1, 1};
  options.renewalRadius = 8.0;
  return options;
}

// Spheres of nested spacing, oriented.
inline Surface sphere(int subdivisions, int levels) {
  Surface surface;
  for (int l = 0; l < levels; ++l) {
    surface.levels.push_back(sphereMesh(subdivisions >> l));
    surface.levels.back().spacing = surface.levels.front().spacing * (1 << l);
  }
  orient(surface, {});
  return surface;
}

// As if nothing had moved.
inline Carried carriedFrom(const TexturedSurface& last) {
  Carried carried;
  carried.orientation = last.orientation;
  carried.color = last.color;
  carried.coordinate = last.coordinate;
  carried.gradient = last.gradient;
  carried.fading = last.fading;
  carried.age = last.age;
  carried.trust.assign(last.positions.size(), 1.0f);
  carried.previousPosition = last.positions;
  return carried;
}

inline Surface surfaceOf(const TexturedSurface& last) {
  Surface surface;
  surface.levels.push_back(last);
  return surface;
}

}  // namespace fluidtex::testing
