// Repulsion of a mesh's vertices one after the other, patch by patch: for points that are all far out of
// balance.
#pragma once

#include "texture/level_set.h"
#include "texture/patches.h"

namespace fluidtex::texture {

// Moves every vertex whose ring lies in its patch away from its neighbours along the level set [Turk91],
// `sweeps` times, where that folds no triangle, and keeps the edges inside the patches Delaunay. `edge`:
// voxels, the mean length of the even mesh's edges, at scale 1. `last`: #V, the last move of each vertex,
// half of which is kept.
void relax(EditableMesh& mesh, const LevelSet& phi, const Patches& patches, float edge, int sweeps);

}  // namespace fluidtex::texture
