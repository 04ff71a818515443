// Spreads points over an iso-surface, before they are connected.
#pragma once

#include "texture/levelset/isosurface.h"

namespace fluidtex::texture {

struct PointSet {
  // Index space: seeds on the zero set, fresh points on the flat triangles of the iso-surface.
  std::vector<Vec3f> position;
  std::vector<Vec3f> normal;  // unit, outward
};

// Points on the surface. First `seeds` (index space; near the zero set), projected, without those closer than
// half a spacing to an earlier one; then random ones wherever there is room, by dart throwing. Random numbers
// are keyed by voxel and `key`, not by frame, so that a liquid at rest keeps its points. Points on opposite
// sides of a thin sheet do not see each other. spacing: voxels, at scale 1.
PointSet spreadPoints(const LevelSet& phi, const IsoSurface& surface, const std::vector<Vec3f>& seeds,
                      float spacing, std::uint64_t key);

}  // namespace fluidtex::texture
