// Positions and directions in metres.
#pragma once

#include <openvdb/math/Vec3.h>

namespace fluidtex::sim {

using Vec3d = openvdb::math::Vec3<double>;

}  // namespace fluidtex::sim
