// Spacing of the points as a field.
#pragma once

#include "texture/levelset/level_set.h"
#include "texture/options.h"

#include <functional>

namespace fluidtex::texture {

// Factor on the spacing, > 0, at each of #P world positions, metres.
using PointScale = std::function<std::vector<float>(const std::vector<Vec3f>&)>;

// Gradient limit of the factor, per spacing: from 1 to 2 over ten spacings.
inline constexpr float kScaleSlope = 0.1f;

// Sets phi's scale: evaluated at its voxels, clamped to kLeastScale .. kLargestScale, not finite values as 1,
// then gradient-limited: lowered where it rises more steeply than kScaleSlope [Persson, "Mesh size functions
// for implicit geometries and PDE-based gradient limiting", 2006].
// spacing: at scale 1, voxels. Throws std::invalid_argument if `scale` returns the wrong number of values.
void layScale(LevelSet& phi, const openvdb::math::Transform& transform, const PointScale& scale,
              float spacing);

}  // namespace fluidtex::texture
