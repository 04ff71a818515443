// The bodies that a liquid consists of: what is connected.
#pragma once

#include "sim/grid/leaf_table.h"
#include "sim/grid/mac_grid.h"
#include "sim/solids/solids.h"

#include <cstdint>
#include <vector>

namespace fluidtex::sim {

struct Bodies {
  static constexpr std::int32_t kNone = -1;

  LeafTable table;               // of the velocity's leaves
  std::vector<std::int32_t> of;  // #voxels: index of the body that a cell is of, or kNone
  // Of each body, how much of it nothing holds along each axis, 0 to 1. Walls hold as much of its mean cross
  // section as they cover; where it does not slip, their area holds along all axes. 0 along all axes where it
  // goes on at an opening, and across a side of symmetry that it touches.
  std::vector<Vec3d> free;

  int size() const { return static_cast<int>(free.size()); }

  // Of a face: the lower one, normal to `axis`, of a cell (leaf * 512 + offset).
  std::int32_t ofFace(std::int64_t cell, int axis) const {
    if (of[cell] != kNone) return of[cell];
    const std::int64_t below = table.neighbor(cell, 2 * axis);
    return below < 0 ? kNone : of[below];
  }
};

// Of the cells outside walls with phi < 0, among the leaves of `topology`. Openings are open and stream sides
// of the domain, and these shapes (level sets of sources and drains).
Bodies bodiesOf(const FloatGrid& phi, const FloatTree& topology, const SolidField& solid,
                const std::vector<const FloatGrid*>& openings);

}  // namespace fluidtex::sim
