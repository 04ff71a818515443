// The spacing of points as a field: by how much they lie further apart, or nearer, than elsewhere.
#pragma once

#include "texture/levelset/level_set.h"
#include "texture/options.h"

#include <functional>

namespace fluidtex::texture {

// For each of #P world positions the factor by which the spacing is larger there, > 0.
using PointScale = std::function<std::vector<float>(const std::vector<Vec3f>&)>;

// By how much the factor may rise over one spacing: over ten of them from 1 to 2.
inline constexpr float kScaleSlope = 0.1f;

// Gives phi the scale: evaluated at its voxels, brought between kLeastScale and kLargestScale, and lowered
// where it rises more steeply than kScaleSlope, as far as needed [Persson, "Mesh size functions for implicit
// geometries and PDE-based gradient limiting", 2006]. What is not finite counts as 1. `spacing`: of scale 1,
// voxels. Throws std::invalid_argument if `scale` gives another number of values than it was asked for.
void layScale(LevelSet& phi, const openvdb::math::Transform& transform, const PointScale& scale,
              float spacing);

}  // namespace fluidtex::texture
