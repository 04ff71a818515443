// Linear interpolation of a frame's velocity.
#pragma once

#include "sim/grid/mac_grid.h"

#include <optional>

namespace fluidtex::caches {

// Unknown values around a place are left out of the mean; where all are, it is zero. One a thread.
class FaceSampler {
 public:
  explicit FaceSampler(const sim::FaceGrids& grids) {
    for (int axis = 0; axis < 3; ++axis) {
      m_grids[axis] = grids.component[axis].get();
      m_accessors[axis].emplace(grids[axis].constTree());
    }
  }

  // Whether a value of each component is known there.
  bool at(const openvdb::Vec3d& x, openvdb::Vec3d& velocity) const {
    bool known = true;
    for (int axis = 0; axis < 3; ++axis) known = component(axis, x, velocity[axis]) && known;
    return known;
  }

 private:
  bool component(int axis, const openvdb::Vec3d& x, double& result) const {
    const openvdb::Vec3d index = m_grids[axis]->worldToIndex(x);
    const openvdb::Coord low = openvdb::Coord::floor(index);
    const openvdb::Vec3d t = index - low.asVec3d();
    double sum = 0.0, weights = 0.0;
    for (int n = 0; n < 8; ++n) {
      const openvdb::Coord corner = low.offsetBy(n >> 2, n >> 1 & 1, n & 1);
      float value = 0.0f;
      if (!m_accessors[axis]->probeValue(corner, value)) continue;
      const double weight =
          (n & 4 ? t[0] : 1.0 - t[0]) * (n & 2 ? t[1] : 1.0 - t[1]) * (n & 1 ? t[2] : 1.0 - t[2]);
      sum += weight * double(value);
      weights += weight;
    }
    result = weights > 0.0 ? sum / weights : 0.0;
    return weights > 0.0;
  }

  const sim::FloatGrid* m_grids[3] = {};
  std::optional<sim::FloatGrid::ConstAccessor> m_accessors[3];
};

}  // namespace fluidtex::caches
