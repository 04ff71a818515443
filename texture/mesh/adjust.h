// The number of a mesh's vertices brought to what it should be.
#pragma once

#include "texture/levelset/level_set.h"
#include "texture/mesh/editable_mesh.h"

namespace fluidtex::texture {

struct AdjustOptions {
  float edge = 1.0f;     // voxels, mean length of an even mesh's edges at scale 1
  double points = 0.0;   // how many vertices there should be
  double slack = 0.0;    // by how much of that the number may be wrong
  bool settled = false;  // the points were even in the last frame: what is out of proportion gets some margin
};

// Splits what is far too long, collapses what is far too short, and then the worst edges just until the
// number of points is within `slack` of what it should be. Lists all vertices whose surroundings changed; the
// mesh there may no longer be Delaunay. `moved`: where given, and the number is right, only edges at these
// vertices are looked at.
std::vector<std::uint32_t> adjustNumber(EditableMesh& mesh, const LevelSet& phi, const AdjustOptions& options,
                                        const std::vector<std::uint32_t>* moved = nullptr);

}  // namespace fluidtex::texture
