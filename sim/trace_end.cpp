#include "sim/trace_end.h"

#include "sim/leaf_table.h"
#include "sim/level_set.h"
#include "sim/trilinear.h"

#include <algorithm>
#include <cmath>

namespace fluidtex::sim {
namespace {

using openvdb::Vec3f;

// A field at a place, in cells from the corner of the cell `origin`.
float valueAt(const FloatGrid::ConstAccessor& field, const Coord& origin, const Vec3f& x) {
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

TraceEnd::End TraceEnd::walk(const Vec3f& start, const Vec3f& end) const {
  // Cells that follow each other lie side by side, so that each tells of the next.
  constexpr float kStep = 0.5f;
  const float deep = -kDeepInSolid * m_h;
  const Vec3f way = end - start;
  const float length = way.length();
  // A trace from a face starts in the cell that it leads into.
  Coord cell = cellAt(start + way * std::min(0.5f, 0.5f * kStep / std::max(length, kStep)));
  Vec3f x = start;
  for (float gone = kStep; x != end; gone += kStep) {
    x = gone < length ? start + way * (gone / length) : end;
    const Coord next = cellAt(x);
    if (next != cell) {
      const VisibleCells* visible = m_nearThinWalls ? m_visibility->around(cell) : nullptr;
      if (visible != nullptr && !sees(*visible, next - cell)) {
        const float farthest = std::min(length, gone + 1.0f);
        return {start + way * (farthest / length), cell};
      }
      cell = next;
    }
    if (m_distance.getValue(next) < 0.0f && valueAt(m_distance, m_origin, x) < deep) return {x, cell};
  }
  return {end, cell};
}

Vec3f TraceEnd::before(int offset, const Vec3f& start, const Vec3f& end) const {
  auto [place, cell] = (*this)(offset, start, end);
  const VisibleCells* visible = m_nearThinWalls ? m_visibility->around(cell) : nullptr;
  if (visible == nullptr) return place;
  for (int a = 0; a < 3; ++a) {
    const float middle = static_cast<float>(cell[a] - m_origin[a]) + 0.5f;
    const int beside = place[a] < middle ? -VisibleCells::kStride[a] : VisibleCells::kStride[a];
    if (!visible->sees(VisibleCells::kMiddle + beside)) place[a] = middle;
  }
  return place;
}

}  // namespace fluidtex::sim
