// Visibility of cells beside thin solids. Stencils that reach across a wall of a few cells would mix the
// liquid on its one side with the air on the other; with visibility they read one side only.
// Source: Guendelman, Selle, Losasso, Fedkiw, "Coupling water and smoke to thin deformable and rigid shells",
// 2005, section 4 (one-sided interpolation by visibility).
#pragma once

#include "numerics/block_table.h"
#include "sim/grid/mac_grid.h"
#include "sim/grid/visible_cells.h"

#include <openvdb/openvdb.h>

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

namespace fluidtex::sim {

using openvdb::Coord;

// Extrapolates values linearly along the axes from visible cells to hidden ones, so that a level set
// continues behind the wall as before it. The sign does not change there, except from liquid to air where the
// value rises by more than `gap` in a cell: liquid that leaves a wall along which its surface lies.
void extrapolateBehind(Stencil& values, const VisibleCells& visible,
                       float gap = std::numeric_limits<float>::infinity());

// The same for a surface that lies on the wall itself and leaves it: values rise by `step` with each cell
// along the axes that the wall blocks.
void riseBehind(Stencil& values, const VisibleCells& visible, float step);

// Moves a place towards a cell's centre until all samples around it are in visible cells, first along the
// axis on which it is farthest. Places: from the centre, in cells. axis: of samples at faces normal to it,
// which lie on the cell's own faces; -1 for samples at cell centres.
openvdb::Vec3f moveToOwnSide(const VisibleCells& visible, openvdb::Vec3f place, int axis = -1);

class Visibility {
 public:
  using Leaf = std::array<VisibleCells, kLeafSize>;

  bool empty() const { return m_leaves.empty(); }
  // Of the cells of one block of 8 x 8 x 8, by its lowest cell; null where all around each is visible.
  const Leaf* leaf(const Coord& origin) const {
    const std::uint32_t number = m_places.find(origin);
    return number == BlockTable::kNone ? nullptr : m_leaves[number].get();
  }
  // Of one cell; null where all around it is visible.
  const VisibleCells* around(const Coord& cell) const;
  // Whether a thin wall hides a cell from another. False for cells more than VisibleCells::kReach apart, of
  // which nothing is known.
  bool hides(const Coord& from, const Coord& cell) const;
  // Whether a cell of the box may have hidden cells around it.
  bool touches(const openvdb::CoordBBox& box) const;

  // origin: of a block that was not added yet.
  void add(const Coord& origin, std::unique_ptr<Leaf> leaf) {
    m_places.enter(origin);
    m_leaves.push_back(std::move(leaf));
  }

 private:
  BlockTable m_places;
  std::vector<std::unique_ptr<Leaf>> m_leaves;  // by number
};

// Visibility from solidPhi and open, as in SolidField. Null where all is visible.
// Of two cells outside solids, one is visible from the other where a path leads there that turns back along
// no axis and passes through open faces only. Cells deeper in the solid than kDeepInSolid, whose values are
// extrapolated from the nearest cell outside, count as that cell.
std::shared_ptr<const Visibility> visibilityOf(const FloatGrid& solidPhi, const FaceGrids& open);

}  // namespace fluidtex::sim
