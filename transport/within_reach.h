// Which places can be those of voxels.
#pragma once

#include <openvdb/openvdb.h>

#include <cmath>

namespace fluidtex::transport {

// Whether a voxel of that number can be, with some more beside it; also false where it is no number.
inline bool withinReach(const openvdb::Vec3d& index) {
  constexpr double kReach = 1 << 30;
  return std::abs(index.x()) < kReach && std::abs(index.y()) < kReach && std::abs(index.z()) < kReach;
}

}  // namespace fluidtex::transport
