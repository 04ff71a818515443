// Adjusts the number of a mesh's vertices by splits and collapses.
#pragma once

#include "texture/levelset/level_set.h"
#include "texture/mesh/editable_mesh.h"

namespace fluidtex::texture {

struct AdjustOptions {
  float edge = 1.0f;     // voxels: mean edge length of an even mesh at scale 1
  double points = 0.0;   // wanted number of vertices
  double slack = 0.0;    // tolerated relative error of that number
  bool settled = false;  // the points were even in the last frame: thresholds get a margin
};

// Splits edges that are far too long, collapses edges that are far too short, then the worst remaining ones
// until the number of vertices is within `slack`. Returns all vertices whose surroundings changed; the mesh
// there may no longer be Delaunay. moved: if given, and the number is right, only edges at these vertices are
// considered.
std::vector<std::uint32_t> adjustNumber(EditableMesh& mesh, const LevelSet& phi, const AdjustOptions& options,
                                        const std::vector<std::uint32_t>* moved = nullptr);

}  // namespace fluidtex::texture
