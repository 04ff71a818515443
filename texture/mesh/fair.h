// Last step of surface preparation: removes folds and spikes.
#pragma once

#include "texture/levelset/level_set.h"
#include "texture/mesh/editable_mesh.h"

namespace fluidtex::texture {

// Smooths the mesh where the level set is sharper than it can follow (rims of sheets, threads and drops
// thinner than an edge, places where a film closes or tears and the interpolated phi has no zero). Afterwards
// the normals of adjacent triangles are less than 90 degrees apart, and no vertex is farther from the mean of
// its neighbours, along its normal, than half its mean edge (MeshStats::folded and spikes).
// Around such places only, vertices leave the level set and edges are split; the rest of the mesh keeps its
// bytes. Drops of fewer than 18 vertices become balls of 18. Keeps the topology.
void fair(EditableMesh& mesh, const LevelSet& phi);

}  // namespace fluidtex::texture
