#include "sim/grid/visibility.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace fluidtex::sim {

openvdb::Vec3f moveToOwnSide(const VisibleCells& visible, openvdb::Vec3f place, int axis) {
  if (axis >= 0) place[axis] = std::clamp(place[axis], -0.5f, 0.5f);
  if (visible.seesNear()) return place;
  // The neighbours on the place's side of the cell's centre, along one axis or several.
  for (int n = 1; n < 8;) {
    int at = VisibleCells::kMiddle, farthest = -1;
    for (int a = 0; a < 3; ++a) {
      if ((n >> a & 1) == 0 || a == axis || place[a] == 0.0f) continue;
      at += place[a] < 0.0f ? -VisibleCells::kStride[a] : VisibleCells::kStride[a];
      if (farthest < 0 || std::abs(place[a]) > std::abs(place[farthest])) farthest = a;
    }
    if (visible.sees(at)) {
      ++n;
      continue;
    }
    place[farthest] = 0.0f;
    n = 1;
  }
  return place;
}

const VisibleCells* Visibility::around(const Coord& cell) const {
  constexpr int kMask = ~(kLeafDim - 1);
  const Leaf* there = leaf(Coord(cell.x() & kMask, cell.y() & kMask, cell.z() & kMask));
  if (there == nullptr) return nullptr;
  const VisibleCells& visible = (*there)[((cell.x() & 7) << 6) + ((cell.y() & 7) << 3) + (cell.z() & 7)];
  return visible.seesAll() ? nullptr : &visible;
}

bool Visibility::hides(const Coord& from, const Coord& cell) const {
  int at = VisibleCells::kMiddle;
  for (int a = 0; a < 3; ++a) {
    const int way = cell[a] - from[a];
    if (std::abs(way) > VisibleCells::kReach) return false;
    at += way * VisibleCells::kStride[a];
  }
  if (at == VisibleCells::kMiddle) return false;
  const VisibleCells* visible = around(from);
  return visible != nullptr && !visible->sees(at);
}

bool Visibility::touches(const openvdb::CoordBBox& box) const {
  constexpr int kMask = ~(kLeafDim - 1);
  for (int i = box.min().x() & kMask; i <= box.max().x(); i += kLeafDim)
    for (int j = box.min().y() & kMask; j <= box.max().y(); j += kLeafDim)
      for (int k = box.min().z() & kMask; k <= box.max().z(); k += kLeafDim)
        if (leaf(Coord(i, j, k)) != nullptr) return true;
  return false;
}

}  // namespace fluidtex::sim
