// Which cells lie on one's own side of a thin solid. Stencils that reach across a wall of a few cells would
// mix the liquid on its one side with the air on its other; with what is known here they read one side only.
// Source: Guendelman, Selle, Losasso, Fedkiw, "Coupling water and smoke to thin deformable and rigid shells",
// 2005, section 4 (one-sided interpolation by visibility).
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/grid/visible_cells.h"

#include <openvdb/openvdb.h>

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <unordered_map>
#include <vector>

namespace fluidtex::sim {

using openvdb::Coord;

// Gives the cells that are not seen the values of those that are, going on linearly along the axes, so that a
// level set runs on behind the wall as it does before it. It does not change its sign there, but from liquid
// to air where it rises by more than `gap` in a cell: liquid that leaves a wall along which its surface lies.
void goOnBehind(Stencil& values, const VisibleCells& visible,
                float gap = std::numeric_limits<float>::infinity());

// The same behind a surface that lies on the wall itself and leaves it: values rise by `step` with each cell
// along the axes that the wall bars.
void riseBehind(Stencil& values, const VisibleCells& visible, float step);

class Visibility {
 public:
  using Leaf = std::array<VisibleCells, kLeafSize>;

  bool empty() const { return m_leaves.empty(); }
  // Of the cells of one block of 8 x 8 x 8, by its lowest cell; null where each sees all around it.
  const Leaf* leaf(const Coord& origin) const {
    const auto found = m_leaves.find(origin);
    return found == m_leaves.end() ? nullptr : found->second.get();
  }
  // Of one cell; null where it sees all around it.
  const VisibleCells* around(const Coord& cell) const;
  // Whether a cell of the box may not see all around it.
  bool touches(const openvdb::CoordBBox& box) const;

  void add(const Coord& origin, std::unique_ptr<Leaf> leaf) { m_leaves.emplace(origin, std::move(leaf)); }

 private:
  std::unordered_map<Coord, std::unique_ptr<Leaf>> m_leaves;
};

// solidPhi, open: as in SolidField. A cell in the open sees another one where a path leads there that turns
// back along no axis and passes through open faces only. Cells deeper in the solid than kDeepInSolid, whose
// values go on from the nearest cell in the open, see and are seen as that one. Null where all see all.
std::shared_ptr<const Visibility> visibilityOf(const FloatGrid& solidPhi, const FaceGrids& open);

}  // namespace fluidtex::sim
