// Points sorted into a grid of cells.
#pragma once

#include "numerics/block_table.h"
#include "texture/loops/parallel.h"
#include "texture/surface.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace fluidtex::texture {

using Cell = std::array<int, 3>;

// Cell along one axis. Clamped at a billion, since a mesh may lie beyond the range of int; the order of min
// and max makes NaN a cell too.
inline int cellAlong(double x) {
  return int(std::max(-1e9, std::min(1e9, std::floor(x))));
}

inline Cell cellAt(const Vec3f& x, double perLength) {
  return {cellAlong(x.x() * perLength), cellAlong(x.y() * perLength), cellAlong(x.z() * perLength)};
}

// As hashOfPlace, but 4x4x4 cells are adjacent, for locality. For a surface the table should have about four
// slots per point, and at least 64.
inline std::size_t nearbySlot(int x, int y, int z, std::size_t mask) {
  const std::size_t cube = hashOfPlace(x >> 2, y >> 2, z >> 2);
  return (cube << 6 | std::size_t((x & 3) << 4 | (y & 3) << 2 | (z & 3))) & mask;
}

// A static set of points, for queries of those near a position.
class PointGrid {
 public:
  PointGrid(const std::vector<Vec3f>& points, double cellSize) : m_perLength(1.0 / cellSize) {
    m_entries.resize(points.size());
    forEachIndex(points.size(), [&](std::uint32_t i) { m_entries[i] = {cellAt(points[i], m_perLength), i}; });
    std::sort(m_entries.begin(), m_entries.end());
  }

  // Calls visit(index) for every point in the 3x3x3 cells around x, in an order that depends on the points
  // alone.
  template <typename Visit>
  void visitNear(const Vec3f& x, const Visit& visit) const {
    const Cell c = cellAt(x, m_perLength);
    for (int i = c[0] - 1; i <= c[0] + 1; ++i) {
      for (int j = c[1] - 1; j <= c[1] + 1; ++j) {  // cells of a column are adjacent
        auto entry = std::lower_bound(m_entries.begin(), m_entries.end(), Entry{{i, j, c[2] - 1}, 0});
        for (; entry != m_entries.end() && entry->cell <= Cell{i, j, c[2] + 1}; ++entry) visit(entry->index);
      }
    }
  }

 private:
  struct Entry {
    Cell cell{};
    std::uint32_t index = 0;
    auto operator<=>(const Entry&) const = default;
  };

  double m_perLength;
  std::vector<Entry> m_entries;
};

}  // namespace fluidtex::texture
