// Where traced paths end beside solids. What lies behind a wall is other liquid, or none: a path that leads
// into a wall, or through one in a step longer than the wall is thick, ends there.
#pragma once

#include "sim/mac_grid.h"
#include "sim/visibility.h"

namespace fluidtex::sim {

// For the traces that start in one leaf. Each thread has its own.
class TraceEnd {
 public:
  // solidPhi: the solids' signed distance in metres. visibility: as in SolidField, null where all see all.
  // Both must outlive this.
  TraceEnd(const FloatGrid& solidPhi, const Visibility* visibility);

  // Of a leaf of cells whose traces lead at most `reach` cells out of it.
  void setLeaf(const Coord& origin, int reach);

  // Whether some cell within reach does not see all around it.
  bool nearThinWalls() const { return m_nearThinWalls; }
  // The solids' distance in the leaf's cell.
  float solidAt(int offset) const { return m_solid[offset]; }

  // The end of a trace from `start`, in or at a face of the leaf's cell `offset`, or else where it is deeper
  // than kDeepInSolid in a solid, or before it enters a cell that is not seen from the one before. Places in
  // cells from the leaf's lower corner.
  openvdb::Vec3f operator()(int offset, const openvdb::Vec3f& start, const openvdb::Vec3f& end) const {
    // Where no solid is nearer than the trace is long there is none on it.
    const float margin = 1.0f;
    if (!m_nearThinWalls && m_solid[offset] > ((end - start).length() + margin) * m_h) return end;
    return walk(start, end);
  }

 private:
  openvdb::Vec3f walk(const openvdb::Vec3f& start, const openvdb::Vec3f& end) const;

  FloatGrid::ConstAccessor m_distance;
  const FloatTree& m_tree;
  const Visibility* m_visibility;
  float m_h;
  Coord m_origin;
  bool m_nearThinWalls = false;
  std::array<float, kLeafSize> m_solid;
};

}  // namespace fluidtex::sim
