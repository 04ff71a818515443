// Where traced paths end beside solids. What lies behind a wall is other liquid, or none: a path that leads
// into a wall, or through one in a step longer than the wall is thick, ends there.
#pragma once

#include "sim/mac_grid.h"
#include "sim/visibility.h"

#include <array>
#include <cmath>

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

  struct End {
    openvdb::Vec3f place;
    Coord cell;  // that its values are seen from: the one that it lies in, or the last one before a wall
  };

  // The end of a trace from `start`, in or at a face of the leaf's cell `offset`. Where it comes to lie
  // deeper than kDeepInSolid in a solid it ends there; where it enters a cell that is not seen from the one
  // before, at most a cell farther. Places in cells from the leaf's lower corner.
  End operator()(int offset, const openvdb::Vec3f& start, const openvdb::Vec3f& end) const {
    // Where no solid is nearer than the trace is long there is none on it.
    const float margin = 1.0f;
    if (!m_nearThinWalls && m_solid[offset] > ((end - start).length() + margin) * m_h)
      return {end, cellAt(end)};
    return walk(start, end);
  }

  // The same for fields that are read as they are: between values of cells that the last one sees.
  openvdb::Vec3f before(int offset, const openvdb::Vec3f& start, const openvdb::Vec3f& end) const;

 private:
  End walk(const openvdb::Vec3f& start, const openvdb::Vec3f& end) const;
  Coord cellAt(const openvdb::Vec3f& place) const {
    return m_origin.offsetBy(static_cast<int>(std::floor(place[0])), static_cast<int>(std::floor(place[1])),
                             static_cast<int>(std::floor(place[2])));
  }

  FloatGrid::ConstAccessor m_distance;
  const FloatTree& m_tree;
  const Visibility* m_visibility;
  float m_h;
  Coord m_origin;
  bool m_nearThinWalls = false;
  std::array<float, kLeafSize> m_solid;
};

}  // namespace fluidtex::sim
