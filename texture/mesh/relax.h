// Repulsion of a mesh's vertices one after the other, patch by patch: for points that are far out of balance.
#pragma once

#include "texture/levelset/level_set.h"
#include "texture/mesh/patches.h"

namespace fluidtex::texture {

// Moves every vertex whose ring lies in its patch away from its neighbours along the level set [Turk91],
// `sweeps` times, where that folds no triangle, and keeps the edges inside the patches Delaunay. `edge`:
// voxels, the mean length of the even mesh's edges, at scale 1. `awake`: #V, is in balance or moves; a vertex
// at rest stays where it is until it would move by more than `wake`, mean edge lengths there.
void relax(EditableMesh& mesh, const LevelSet& phi, const Patches& patches, float edge, int sweeps,
           float wake, std::vector<std::uint8_t>& awake);

}  // namespace fluidtex::texture
