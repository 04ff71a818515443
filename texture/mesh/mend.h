// The last repairs of a mesh on a level set, where the surface is too sharp or too thin for its points.
#pragma once

#include "texture/levelset/level_set.h"
#include "texture/mesh/editable_mesh.h"

namespace fluidtex::texture {

// Flips, collapses and splits edges and moves vertices at triangles that face inwards, lie far from the level
// set, are slim or have edges of more than two spacings, one after the other, as long as that helps. Keeps
// the mesh closed and manifold and its topology. `spacing` in voxels, at scale 1.
void mend(EditableMesh& mesh, const LevelSet& phi, float spacing);

}  // namespace fluidtex::texture
