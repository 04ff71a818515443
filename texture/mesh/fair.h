// The last step of a surface's preparation: nothing sticks out, and no edge folds.
#pragma once

#include "texture/levelset/level_set.h"
#include "texture/mesh/editable_mesh.h"

namespace fluidtex::texture {

// Where the level set is sharper than the mesh can follow (rims of sheets, threads and drops thinner than an
// edge, places where a film closes or tears and the interpolated phi has no zero), rounds the mesh off:
// afterwards the normals of triangles side by side lie less than 90 degrees apart, and no vertex is farther
// from the mean of its neighbours, along its normal, than half its mean edge (MeshStats::folded and spikes).
// Vertices leave the level set for it and edges are split, around such places only; all else keeps its bytes.
// Drops of fewer than 18 vertices become balls of 18. The topology stays as it is.
void fair(EditableMesh& mesh, const LevelSet& phi);

}  // namespace fluidtex::texture
