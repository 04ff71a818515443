// A sphere with a field of directions, for tests of what is shown on a surface.
#pragma once

#include "tests/texture/mesh/closed_meshes.h"
#include "texture/orientation/tangent.h"

namespace fluidtex::testing {

inline texture::Surface orientedSphere() {
  texture::Surface surface;
  surface.levels.push_back(sphereMesh(4));
  surface.levels[0].orientation = texture::referenceVectors(surface.levels[0].normals);
  return surface;
}

}  // namespace fluidtex::testing
