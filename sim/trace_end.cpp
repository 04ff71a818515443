#include "sim/trace_end.h"

#include "sim/leaf_table.h"
#include "sim/level_set.h"
#include "sim/trilinear.h"

#include <algorithm>
#include <cmath>

namespace fluidtex::sim {
namespace {

using openvdb::Vec3f;

// The cell that a place lies in; the place in cells from the cell `origin`.
Coord cellAt(const Coord& origin, const Vec3f& x) {
  return origin.offsetBy(static_cast<int>(std::floor(x[0])), static_cast<int>(std::floor(x[1])),
                         static_cast<int>(std::floor(x[2])));
}

// The solids' distance at a place.
float distanceAt(const FloatGrid::ConstAccessor& distance, const Coord& origin, const Vec3f& x) {
  const Vec3f from = x - Vec3f(0.5f);
  const Coord low = cellAt(origin, from);
  const Vec3f t = from - Vec3f((low - origin).asVec3s());
  float corners[8];
  for (int n = 0; n < 8; ++n) corners[n] = distance.getValue(low.offsetBy(n >> 2, n >> 1 & 1, n & 1));
  return trilinear(corners, 4, 2, t[0], t[1], t[2]);
}

bool sees(const VisibleCells& visible, const Coord& offset) {
  int at = VisibleCells::kMiddle;
  for (int a = 0; a < 3; ++a) at += offset[a] * VisibleCells::kStride[a];
  return visible.sees(at);
}

}  // namespace

TraceEnd::TraceEnd(const FloatGrid& solidPhi, const Visibility* visibility)
    : m_distance(solidPhi.getConstAccessor()),
      m_tree(solidPhi.constTree()),
      m_visibility(visibility),
      m_h(static_cast<float>(solidPhi.voxelSize()[0])) {}

void TraceEnd::setLeaf(const Coord& origin, int reach) {
  m_origin = origin;
  float scratch[kLeafSize];
  std::copy_n(leafValues(m_tree, origin, scratch), kLeafSize, m_solid.begin());
  m_nearThinWalls =
      m_visibility != nullptr && m_visibility->touches(grown(CoordBBox::createCube(origin, kLeafDim), reach));
}

Vec3f TraceEnd::walk(const Vec3f& start, const Vec3f& end) const {
  // Cells that follow each other lie side by side, so that each tells of the next.
  constexpr float kStep = 0.5f;
  const float deep = -kDeepInSolid * m_h;
  const Vec3f way = end - start;
  const float length = way.length();
  Vec3f last = start;
  // A trace from a face starts in the cell that it leads into.
  Coord cell = cellAt(m_origin, start + way * std::min(0.5f, 0.5f * kStep / std::max(length, kStep)));
  for (float gone = kStep; last != end; gone += kStep) {
    const Vec3f x = gone < length ? start + way * (gone / length) : end;
    const Coord next = cellAt(m_origin, x);
    if (next != cell) {
      const VisibleCells* visible = m_nearThinWalls ? m_visibility->around(cell) : nullptr;
      if (visible != nullptr && !sees(*visible, next - cell)) return last;
      cell = next;
    }
    if (m_distance.getValue(next) < 0.0f && distanceAt(m_distance, m_origin, x) < deep) return x;
    last = x;
  }
  return end;
}

}  // namespace fluidtex::sim
