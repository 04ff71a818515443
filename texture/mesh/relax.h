// Gauss-Seidel repulsion of a mesh's vertices, patch by patch, for points far out of balance.
#pragma once

#include "texture/levelset/level_set.h"
#include "texture/mesh/patches.h"

namespace fluidtex::texture {

// `sweeps` times, moves every vertex whose one-ring its patch owns away from its neighbours along the level
// set [Turk91], where that folds no triangle, and keeps edges inside patches Delaunay. edge: voxels, mean
// edge length of the even mesh at scale 1. awake: #V, in and out: 1 if out of balance. A vertex at rest wakes
// only for a move of more than `wake`, mean edge lengths.
void relax(EditableMesh& mesh, const LevelSet& phi, const Patches& patches, float edge, int sweeps,
           float wake, std::vector<std::uint8_t>& awake);

}  // namespace fluidtex::texture
