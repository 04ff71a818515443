// Range check of voxel indices.
#pragma once

#include <openvdb/openvdb.h>

#include <cmath>

namespace fluidtex::transport {

// Whether a voxel index fits an int with some margin; false for NaN too.
inline bool withinReach(const openvdb::Vec3d& index) {
  constexpr double kReach = 1 << 30;
  return std::abs(index.x()) < kReach && std::abs(index.y()) < kReach && std::abs(index.z()) < kReach;
}

}  // namespace fluidtex::transport
