// Visibility of cells beside thin solids. Stencils that reach across a wall of a few cells would mix the
// liquid on its one side with the air on the other; with visibility they read one side only.
// Source: Guendelman, Selle, Losasso, Fedkiw, "Coupling water and smoke to thin deformable and rigid shells",
// 2005, section 4 (one-sided interpolation by visibility).
#pragma once

#include "numerics/block_table.h"
#include "sim/grid/mac_grid.h"
#include "sim/grid/visible_cells.h"

#include <array>
#include <memory>
#include <utility>
#include <vector>

namespace fluidtex::sim {

// Moves a place towards a cell's centre until all samples around it are in visible cells, first along the
// axis on which it is farthest. Places: from the centre, in cells. axis: of samples at faces normal to it,
// which lie on the cell's own faces; -1 for samples at cell centres.
openvdb::Vec3f moveToOwnSide(const VisibleCells& visible, openvdb::Vec3f place, int axis = -1);

// What the cells of a grid see of each other.
class Visibility {
 public:
  using Leaf = std::array<VisibleCells, kLeafSize>;

  bool empty() const { return m_leaves.empty(); }
  // Of the cells of one block of 8 x 8 x 8, by its lowest cell; null where all around each is visible.
  const Leaf* leaf(const Coord& origin) const {
    const std::uint32_t number = m_numbers.find(origin);
    return number == BlockTable::kNone ? nullptr : m_leaves[number].get();
  }
  // Of one cell; null where all around it is visible.
  const VisibleCells* around(const Coord& cell) const;
  // Whether a thin wall hides a cell from another. False for cells more than VisibleCells::kReach apart, of
  // which nothing is known.
  bool hides(const Coord& from, const Coord& cell) const;
  // Whether a cell of the box may have hidden cells around it.
  bool touches(const openvdb::CoordBBox& box) const;

  // The lowest cells of the blocks that were added; cells of others see all around.
  const std::vector<Coord>& origins() const { return m_origins; }
  // origin: of a block that was not added yet.
  void add(const Coord& origin, std::unique_ptr<Leaf> leaf) {
    m_numbers.enter(origin);
    m_origins.push_back(origin);
    m_leaves.push_back(std::move(leaf));
  }

 private:
  BlockTable m_numbers;
  std::vector<Coord> m_origins;
  std::vector<std::unique_ptr<Leaf>> m_leaves;
};

}  // namespace fluidtex::sim
