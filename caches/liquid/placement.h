// Where a cache's liquid lies in the world: metres, Z up.
#pragma once

#include "caches/options.h"

#include <openvdb/math/Mat3.h>
#include <openvdb/math/Mat4.h>

namespace fluidtex::caches {

// Positions of the files to metres, of row vectors as OpenVDB's matrices are: world = m.transform(x).
openvdb::Mat4d worldFromFile(const Options& options);

// Velocities of the files, per second in their unit, to m/s: v_world = m.transform(v).
openvdb::Mat3d velocityFromFile(const Options& options);

}  // namespace fluidtex::caches
