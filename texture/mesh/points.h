// Points spread over an iso-surface, before they are connected.
#pragma once

#include "texture/levelset/isosurface.h"

namespace fluidtex::texture {

struct PointSet {
  // Index space: seeds on the zero set, fresh points on the flat triangles of the iso-surface.
  std::vector<Vec3f> position;
  std::vector<Vec3f> normal;  // unit, outward
};

// `seeds` (index space; near the zero set) brought onto the surface, without those nearer than half a spacing
// to an earlier one; then fresh points at random by area wherever there is room for them: dart throwing,
// keyed by the voxel and `key`, not by anything that changes from frame to frame. Points on opposite sides of
// a thin sheet do not see each other. `spacing` in voxels, at scale 1.
PointSet spreadPoints(const LevelSet& phi, const IsoSurface& surface, const std::vector<Vec3f>& seeds,
                      float spacing, std::uint64_t key);

}  // namespace fluidtex::texture
