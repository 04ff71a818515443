// A triangle mesh of the surroundings: everything in the picture that is not liquid.
#pragma once

#include "render/vec.h"
#include "texture/surface.h"

#include <vector>

namespace fluidtex::render {

enum class MeshKind { matt, ground };

struct Mesh {
  MeshKind kind = MeshKind::matt;
  std::vector<Vec3f> positions;
  std::vector<texture::Vec3I> triangles;
  Vec3f color{0.5f};  // linear
};

}  // namespace fluidtex::render
