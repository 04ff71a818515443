// Connects points to a mesh of given topology: mutual tessellation [Turk92].
#pragma once

#include "texture/levelset/isosurface.h"
#include "texture/mesh/editable_mesh.h"
#include "texture/mesh/points.h"

namespace fluidtex::texture {

// A mesh with vertices `points` and the topology of `surface`: the points are inserted into the iso-surface's
// triangles, then its own vertices are removed wherever that keeps the topology and folds nothing; the few
// others stay as further points. Points that cannot be inserted are left out. spacing: voxels, at scale 1.
EditableMesh connectPoints(const LevelSet& phi, const IsoSurface& surface, const PointSet& points,
                           float spacing);

}  // namespace fluidtex::texture
