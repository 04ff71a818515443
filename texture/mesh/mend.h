// Repairs a mesh where the level set is too sharp or too thin for its points.
#pragma once

#include "texture/levelset/level_set.h"
#include "texture/mesh/editable_mesh.h"

namespace fluidtex::texture {

// At triangles that face inwards, lie far from the level set, are slim or have edges longer than two
// spacings: applies flips, collapses, splits and moves of vertices, the best one first, as long as they help.
// Keeps the mesh closed and manifold and its topology. spacing: voxels, at scale 1.
void mend(EditableMesh& mesh, const LevelSet& phi, float spacing);

}  // namespace fluidtex::texture
