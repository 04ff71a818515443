// End points of traces beside solids. Behind a wall is other liquid, or none: a trace that leads into a wall,
// or through one in a step longer than the wall is thick, ends there.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/solids/visibility.h"

#include <array>
#include <cmath>

namespace fluidtex::sim {

// For the traces that start in one leaf. Not shared between threads. Places are in cells from the leaf's
// lower corner.
class TraceEnd {
 public:
  // solidPhi: the solids' signed distance in metres. visibility: as in SolidField, null where all is visible.
  // Both must outlive this.
  TraceEnd(const FloatGrid& solidPhi, const Visibility* visibility);

  // Selects the leaf. Traces lead at most `reach` cells out of it, no more than kLeafDim.
  void setLeaf(const Coord& origin, int reach);

  // Whether cells around some cell within reach are hidden by a wall.
  bool nearThinWalls() const { return m_nearThinWalls; }
  // The solids' distance at the leaf's cell, metres.
  float solidAt(int offset) const { return m_solid[offset]; }

  struct End {
    openvdb::Vec3f place;
    Coord cell;  // from which values are visible: that of `place`, or the last one before a wall
  };

  // The end of a trace from `start`, in or at a face of the leaf's cell `offset`, to `aim`. It ends where it
  // is half a cell deep in a solid. Where it enters a cell that is not visible from the last one, it
  // continues for a cell at most.
  End operator()(int offset, const openvdb::Vec3f& start, const openvdb::Vec3f& aim) const {
    if (isClear(offset, start, aim)) return {aim, cellAt(aim)};
    return walk(start, aim);
  }

  // The same for fields that are interpolated without regard to walls: all eight cells around the returned
  // place are visible from the last cell before the wall.
  // axis: of the samples at faces normal to it, which lie on the cell's own faces; -1 for samples at cell
  // centres.
  openvdb::Vec3f onOwnSide(int offset, const openvdb::Vec3f& start, const openvdb::Vec3f& aim,
                           int axis = -1) const;

 private:
  // Whether no solid is as near to the start as the end is. The start lies within a cell of the centre, at
  // which the distance is known.
  bool isClear(int offset, const openvdb::Vec3f& start, const openvdb::Vec3f& aim) const {
    return !m_nearSolids || m_solid[offset] > ((aim - start).length() + 1.0f) * m_h;
  }
  End walk(const openvdb::Vec3f& start, const openvdb::Vec3f& aim) const;
  Coord cellAt(const openvdb::Vec3f& place) const {
    return m_origin.offsetBy(static_cast<int>(std::floor(place[0])), static_cast<int>(std::floor(place[1])),
                             static_cast<int>(std::floor(place[2])));
  }

  FloatGrid::ConstUnsafeAccessor m_distance;
  const FloatTree& m_tree;
  const Visibility* m_visibility;
  float m_h;
  Coord m_origin;
  bool m_nearSolids = false, m_nearThinWalls = false;
  std::array<float, kLeafSize> m_solid;
};

}  // namespace fluidtex::sim
