// Shapes of the level-set tests as exact signed distances, negative inside; metres. 2D shapes stand upright
// along z.
#pragma once

#include "sim/options.h"

#include <functional>

namespace fluidtex::validation {

using sim::Vec3d;
using Distance = std::function<double(const Vec3d&)>;

Distance circle(double x, double y, double radius);
Distance sphere(const Vec3d& center, double radius);

// Zalesak's disk in the unit square: centre (0.5, 0.75), radius 0.15, a slot 0.05 wide that is closed at y =
// 0.85. Exact outside and near the surface, corners included.
Distance slottedDisk();

// The same of a sphere centred at (0.5, 0.75, 0.5), its slot through along z and 0.125 deep.
Distance slottedSphere();

}  // namespace fluidtex::validation
