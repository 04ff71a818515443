// Points connected into a mesh of a given topology [Turk92, mutual tessellation].
#pragma once

#include "texture/levelset/isosurface.h"
#include "texture/mesh/editable_mesh.h"
#include "texture/mesh/points.h"

namespace fluidtex::texture {

// A mesh whose vertices are `points` and whose topology is that of `surface`: the points are brought into the
// iso-surface's triangles, then the iso-surface's own vertices are removed one by one wherever that changes
// no topology and folds nothing; the few that cannot be removed stay as further points. A point that finds no
// place is left out. `spacing` in voxels, at scale 1.
EditableMesh connectPoints(const LevelSet& phi, const IsoSurface& surface, const PointSet& points,
                           float spacing);

}  // namespace fluidtex::texture
