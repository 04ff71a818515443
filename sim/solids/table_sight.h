// Neighbours of cells and faces in a leaf table, on their own side of thin walls.
#pragma once

#include "sim/grid/leaf_table.h"
#include "sim/solids/visibility.h"

#include <cstdint>
#include <vector>

namespace fluidtex::sim {

// Voxels and directions as in LeafTable. -1 stands for a neighbour that is not there, or that a wall hides.
class TableSight {
 public:
  // visibility: as in SolidField, null where all is visible. Both must outlive this.
  TableSight(const LeafTable& table, const Visibility* visibility);

  // Whether anything is hidden from cells of a leaf.
  bool any(std::size_t leaf) const { return m_leaves[leaf] != nullptr; }

  // The neighbour of a cell.
  std::int64_t cell(std::int64_t cell, int direction) const {
    return sees(cell, direction) ? m_table.neighbor(cell, direction) : -1;
  }

  // Whether a thin wall separates the two cells of a face normal to `axis`: both sides read it, and it
  // belongs to neither.
  bool inWall(std::int64_t face, int axis) const { return !sees(face, 2 * axis); }

  // Whether a thin wall hides the neighbour of a face among those normal to `axis`. Faces beside each other
  // are visible where cells on one side of them are, faces in line share a cell.
  bool hidesFace(std::int64_t face, int axis, int direction) const {
    if (direction >> 1 == axis || sees(face, direction)) return false;
    const std::int64_t below = m_table.neighbor(face, 2 * axis);
    return below < 0 || !sees(below, direction);
  }

  // The neighbour of a face among those normal to `axis`, unless it lies in a thin wall.
  std::int64_t face(std::int64_t face, int axis, int direction) const {
    const std::int64_t next = m_table.neighbor(face, direction);
    return next < 0 || inWall(next, axis) || hidesFace(face, axis, direction) ? -1 : next;
  }

 private:
  bool sees(std::int64_t cell, int direction) const {
    const Visibility::Leaf* leaf = m_leaves[static_cast<std::size_t>(cell >> 9)];
    if (leaf == nullptr) return true;
    const int stride = VisibleCells::kStride[direction >> 1];
    return (*leaf)[static_cast<std::size_t>(cell & 511)].sees(VisibleCells::kMiddle +
                                                              ((direction & 1) != 0 ? stride : -stride));
  }

  const LeafTable& m_table;
  std::vector<const Visibility::Leaf*> m_leaves;  // #leaves; null where all is visible
};

}  // namespace fluidtex::sim
