#include "sim/solids/trace_end.h"

#include "sim/grid/leaf_table.h"
#include "sim/grid/trilinear.h"
#include "sim/solids/solid_layers.h"

#include <algorithm>

namespace fluidtex::sim {
namespace {

using openvdb::Vec3f;

// Value of a field at a place, in cells from the corner of the cell `origin`.
float valueAt(const FloatGrid::ConstUnsafeAccessor& field, const Coord& origin, const Vec3f& x) {
  Coord low = origin;
  float t[3];
  for (int a = 0; a < 3; ++a) {
    const float from = x[a] - 0.5f, whole = std::floor(from);
    low[a] += static_cast<int>(whole);
    t[a] = from - whole;
  }
  float corners[8];
  for (int n = 0; n < 8; ++n) corners[n] = field.getValue(low.offsetBy(n >> 2, n >> 1 & 1, n & 1));
  return trilinear(corners, 4, 2, t[0], t[1], t[2]);
}

}  // namespace

TraceEnd::TraceEnd(const FloatGrid& solidPhi, const Visibility* visibility)
    : m_distance(solidPhi.getConstUnsafeAccessor()),
      m_tree(solidPhi.constTree()),
      m_visibility(visibility),
      m_h(static_cast<float>(solidPhi.voxelSize()[0])) {}

void TraceEnd::setLeaf(const Coord& origin, int reach) {
  m_origin = origin;
  float scratch[kLeafSize];
  std::copy_n(leafValues(m_tree, origin, scratch), kLeafSize, m_solid.begin());
  m_nearSolids = false;
  for (int n = 0; n < 27 && !m_nearSolids; ++n) {
    const Coord beside =
        origin.offsetBy(kLeafDim * (n / 9 - 1), kLeafDim * (n / 3 % 3 - 1), kLeafDim * (n % 3 - 1));
    m_nearSolids = m_tree.probeConstLeaf(beside) != nullptr || m_tree.getValue(beside) < 0.0f;
  }
  m_nearThinWalls = m_nearSolids && m_visibility != nullptr &&
                    m_visibility->touches(grown(CoordBBox::createCube(origin, kLeafDim), reach));
}

TraceEnd::End TraceEnd::walk(const Vec3f& start, const Vec3f& aim) const {
  // Successive cells are neighbours, so that visibility from each covers the next.
  constexpr float kStep = 0.5f;
  const float deep = -kDeepInSolid * m_h;
  const Vec3f way = aim - start;
  const float length = way.length();
  // A trace from a face starts in the cell that it leads into.
  Coord cell = cellAt(start + way * std::min(0.5f, 0.5f * kStep / std::max(length, kStep)));
  for (float gone = kStep; gone < length + kStep; gone += kStep) {
    const Vec3f x = gone < length ? start + way * (gone / length) : aim;
    const Coord next = cellAt(x);
    if (next != cell) {
      if (m_nearThinWalls && m_visibility->hides(cell, next)) {
        const float farthest = std::min(length, gone + 1.0f);
        return {start + way * (farthest / length), cell};
      }
      cell = next;
    }
    if (m_distance.getValue(next) < 0.0f && valueAt(m_distance, m_origin, x) < deep) return {x, cell};
  }
  return {aim, cell};
}

Vec3f TraceEnd::onOwnSide(int offset, const Vec3f& start, const Vec3f& aim, int axis) const {
  if (isClear(offset, start, aim)) return aim;
  const auto [place, cell] = walk(start, aim);
  const VisibleCells* visible = m_nearThinWalls ? m_visibility->around(cell) : nullptr;
  if (visible == nullptr) return place;
  const Vec3f middle = (cell - m_origin).asVec3s() + Vec3f(0.5f);
  return middle + moveToOwnSide(*visible, place - middle, axis);
}

}  // namespace fluidtex::sim
