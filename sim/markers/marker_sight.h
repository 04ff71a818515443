// Visibility for markers beside thin walls: that of the nearest cell.
#pragma once

#include "sim/markers/markers.h"
#include "sim/solids/visibility.h"

#include <cmath>

namespace fluidtex::sim {

// The cell whose centre is nearest to a marker, along one axis.
inline int nearestCell(float x) {
  return static_cast<int>(std::floor(x + 0.5f));
}

// Visibility for the markers of one block.
class Sight {
 public:
  // visibility: null where no solid is thin. reach: cells that markers come out of the block.
  Sight(const Visibility* visibility, const Coord& origin, int reach = 0)
      : m_visibility(visibility), m_origin(origin) {
    if (visibility == nullptr ||
        !visibility->touches(openvdb::CoordBBox(origin.offsetBy(-reach), origin.offsetBy(kLeafDim + reach))))
      m_visibility = nullptr;
  }
  bool any() const { return m_visibility != nullptr; }
  // null where all is visible.
  const VisibleCells* at(const Marker& m) const {
    if (m_visibility == nullptr) return nullptr;
    return m_visibility->around(m_origin + nearestTo(m));
  }
  // Whether a thin wall separates two places of a marker. False for places more than two cells apart, where
  // nothing is known.
  bool parts(const Marker& from, const Marker& to) const {
    return m_visibility != nullptr &&
           m_visibility->hides(m_origin + nearestTo(from), m_origin + nearestTo(to));
  }

 private:
  static Coord nearestTo(const Marker& m) { return {nearestCell(m.x), nearestCell(m.y), nearestCell(m.z)}; }

  const Visibility* m_visibility;
  Coord m_origin;
};

}  // namespace fluidtex::sim
