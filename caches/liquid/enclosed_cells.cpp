// Blocks that nothing crosses are taken together along z, from one that is crossed to the next; those that
// are crossed are divided into their connected cells. What is beside each other is then joined.
#include "caches/liquid/enclosed_cells.h"

#include "caches/liquid/connected.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>

namespace fluidtex::caches {
namespace {

using openvdb::Coord;
using openvdb::CoordBBox;
using sim::kLeafSize;
using sim::LeafBits;

// In units of blocks.
Coord blockOf(const Coord& origin) {
  return Coord(origin[0] >> 3, origin[1] >> 3, origin[2] >> 3);
}

bool isCrossed(const CrossedLines& lines) {
  for (const LeafBits& bits : lines)
    if (std::any_of(bits.begin(), bits.end(), [](std::uint64_t word) { return word != 0; })) return true;
  return false;
}

// All cells that ways within the block lead to from these.
LeafBits reached(LeafBits cells, const CrossedLines& lines) {
  constexpr std::uint64_t kNotLastInRow = 0x7f7f7f7f7f7f7f7full, kNotLastRow = ~std::uint64_t{0} >> 8;
  for (bool grows = true; grows;) {
    grows = false;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const std::uint64_t freeY = ~lines[1][i] & kNotLastRow, freeZ = ~lines[2][i] & kNotLastInRow;
      std::uint64_t word = cells[i];
      if (i > 0) word |= cells[i - 1] & ~lines[0][i - 1];
      if (i + 1 < cells.size()) word |= cells[i + 1] & ~lines[0][i];
      for (std::uint64_t last = 0; word != last;) {
        last = word;
        word |= (word & freeY) << 8 | (word >> 8 & freeY);
        word |= (word & freeZ) << 1 | (word >> 1 & freeZ);
      }
      grows = grows || word != cells[i];
      cells[i] = word;
    }
  }
  return cells;
}

// The connected parts of a crossed block.
struct Parts {
  std::array<std::uint16_t, kLeafSize> of;  // of each cell
  std::uint32_t count = 0;
};

Parts partsOf(const CrossedLines& lines) {
  Parts parts;
  LeafBits left;
  left.fill(~std::uint64_t{0});
  for (std::size_t i = 0; i < left.size(); ++i)
    while (left[i] != 0) {
      LeafBits seed{};
      seed[i] = left[i] & -left[i];
      const LeafBits part = reached(seed, lines);
      sim::forBits(part, 0,
                   [&](std::int64_t cell) { parts.of[std::size_t(cell)] = std::uint16_t(parts.count); });
      for (std::size_t n = 0; n < left.size(); ++n) left[n] &= ~part[n];
      ++parts.count;
    }
  return parts;
}

// Crossed blocks above each other, [first, last) of the sorted ones. Between them and beyond them are gaps:
// gap n lies below block first + n.
struct Column {
  int x, y;
  int first, last;
  std::uint32_t firstGap;  // as a thing that is connected
};

class Division {
 public:
  Division(const sim::LeafTable& blocks, const std::vector<CrossedLines>& crossed) : m_crossed(crossed) {
    for (std::size_t n = 0; n < crossed.size(); ++n)
      if (isCrossed(crossed[n])) m_blocks.push_back(n);
    const auto place = [&](std::size_t n) { return blockOf(blocks.origins[n]); };
    std::sort(m_blocks.begin(), m_blocks.end(),
              [&](std::size_t a, std::size_t b) { return place(a) < place(b); });
    m_parts.resize(m_blocks.size());
    tbb::parallel_for(std::size_t{0}, m_blocks.size(),
                      [&](std::size_t n) { m_parts[n] = partsOf(crossed[m_blocks[n]]); });
    std::uint32_t count = 1;  // the first one is what lies outside of all columns
    for (std::size_t n = 0; n < m_blocks.size(); ++n) {
      const Coord at = place(m_blocks[n]);
      m_heights.push_back(at[2]);
      if (m_columns.empty() || m_columns.back().x != at[0] || m_columns.back().y != at[1])
        m_columns.push_back({at[0], at[1], int(n), int(n), 0});
      ++m_columns.back().last;
      m_firstPart.push_back(count);
      count += m_parts[n].count;
    }
    for (Column& column : m_columns) {
      column.firstGap = count;
      count += std::uint32_t(column.last - column.first + 1);
    }
    m_connected = Connected(count);
    for (const Column& column : m_columns) joinWithin(column);
    for (const Column& column : m_columns) {
      joinSide(column, 0);
      joinSide(column, 1);
    }
  }

  EnclosedCells enclosed(const sim::LeafTable& blocks) {
    EnclosedCells result;
    result.cells.resize(blocks.size());
    const auto isOutside = [&](std::uint32_t thing) { return m_connected.lowest(thing) == kOutside; };
    std::vector<bool> isDone(blocks.size());
    for (std::size_t n = 0; n < m_blocks.size(); ++n) {
      isDone[m_blocks[n]] = true;
      std::vector<bool> outside(m_parts[n].count);
      for (std::uint32_t part = 0; part < m_parts[n].count; ++part)
        outside[part] = isOutside(m_firstPart[n] + part);
      for (int cell = 0; cell < kLeafSize; ++cell)
        if (!outside[m_parts[n].of[std::size_t(cell)]]) sim::setBit(result.cells[m_blocks[n]], cell);
    }
    for (std::size_t n = 0; n < blocks.size(); ++n) {
      if (isDone[n]) continue;
      const Coord at = blockOf(blocks.origins[n]);
      const Column* column = columnAt(at[0], at[1]);
      if (column != nullptr && !isOutside(gapAt(*column, at[2]))) result.cells[n].fill(~std::uint64_t{0});
    }
    for (const Column& column : m_columns)
      for (int gap = 1; gap < column.last - column.first; ++gap) {
        const auto [low, high] = extent(column, gap);
        if (low > high || isOutside(column.firstGap + std::uint32_t(gap))) continue;
        const Coord first(sim::kLeafDim * column.x, sim::kLeafDim * column.y, sim::kLeafDim * int(low));
        result.boxes.emplace_back(first, first + Coord(sim::kLeafDim - 1, sim::kLeafDim - 1,
                                                       sim::kLeafDim * int(high - low + 1) - 1));
      }
    return result;
  }

 private:
  static constexpr std::uint32_t kOutside = 0;

  // The lowest and highest place of a gap, which may be empty.
  std::pair<std::int64_t, std::int64_t> extent(const Column& column, int gap) const {
    constexpr std::int64_t kFar = std::int64_t{1} << 40;
    const int above = column.first + gap;
    return {gap == 0 ? -kFar : std::int64_t{m_heights[std::size_t(above - 1)]} + 1,
            above == column.last ? kFar : std::int64_t{m_heights[std::size_t(above)]} - 1};
  }

  std::uint32_t gapAt(const Column& column, int height) const {
    const auto begin = m_heights.begin() + column.first, end = m_heights.begin() + column.last;
    return column.firstGap + std::uint32_t(std::lower_bound(begin, end, height) - begin);
  }

  // Joins the cells of block n on its upper or lower side along an axis with what partOther gives for them.
  template <class PartOther>
  void joinSide(int n, int axis, bool upper, const PartOther& partOther) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const Parts& parts = m_parts[std::size_t(n)];
    const LeafBits& lines = m_crossed[m_blocks[std::size_t(n)]][std::size_t(axis)];
    std::uint32_t lastHere = ~0u, lastThere = ~0u;
    for (int p = 0; p < sim::kLeafDim; ++p)
      for (int q = 0; q < sim::kLeafDim; ++q) {
        const int cell = sim::kLeafStride[u] * p + sim::kLeafStride[v] * q +
                         (upper ? sim::kLeafStride[axis] * (sim::kLeafDim - 1) : 0);
        if (upper && (lines[std::size_t(cell >> 6)] >> (cell & 63) & 1) != 0) continue;
        const std::uint32_t here = m_firstPart[std::size_t(n)] + parts.of[std::size_t(cell)];
        const std::uint32_t there = partOther(sim::kLeafStride[u] * p + sim::kLeafStride[v] * q);
        if (here == lastHere && there == lastThere) continue;
        m_connected.join(here, there);
        lastHere = here;
        lastThere = there;
      }
  }

  void joinToGap(int n, int axis, bool upper, std::uint32_t gap) {
    joinSide(n, axis, upper, [=](int) { return gap; });
  }

  void joinToBlock(int n, int axis, int above) {
    joinSide(n, axis, true, [&](int cell) {
      return m_firstPart[std::size_t(above)] + m_parts[std::size_t(above)].of[std::size_t(cell)];
    });
  }

  void joinWithin(const Column& column) {
    const int gaps = column.last - column.first + 1;
    m_connected.join(column.firstGap, kOutside);
    m_connected.join(column.firstGap + std::uint32_t(gaps - 1), kOutside);
    for (int n = column.first; n < column.last; ++n) {
      const std::uint32_t below = column.firstGap + std::uint32_t(n - column.first);
      if (n == column.first || m_heights[std::size_t(n - 1)] + 1 < m_heights[std::size_t(n)])
        joinToGap(n, 2, false, below);
      if (n + 1 < column.last && m_heights[std::size_t(n)] + 1 == m_heights[std::size_t(n + 1)])
        joinToBlock(n, 2, n + 1);
      else
        joinToGap(n, 2, true, below + 1);
    }
  }

  const Column* columnAt(int x, int y) const {
    const auto found = std::lower_bound(m_columns.begin(), m_columns.end(), std::pair(x, y),
                                        [](const Column& column, const std::pair<int, int>& at) {
                                          return std::pair(column.x, column.y) < at;
                                        });
    return found != m_columns.end() && found->x == x && found->y == y ? &*found : nullptr;
  }

  // With the columns to both sides along axis 0 or 1.
  void joinSide(const Column& column, int axis) {
    const int dx = axis == 0 ? 1 : 0, dy = 1 - dx;
    if (columnAt(column.x - dx, column.y - dy) == nullptr) joinOutside(column, axis, false);
    const Column* above = columnAt(column.x + dx, column.y + dy);
    if (above == nullptr) {
      joinOutside(column, axis, true);
      return;
    }
    for (int n = column.first; n < column.last; ++n) {
      const int height = m_heights[std::size_t(n)];
      const std::uint32_t gap = gapAt(*above, height);
      const int next = above->first + int(gap - above->firstGap);
      if (next < above->last && m_heights[std::size_t(next)] == height)
        joinToBlock(n, axis, next);
      else
        joinToGap(n, axis, true, gap);
    }
    for (int n = above->first; n < above->last; ++n) {
      const int height = m_heights[std::size_t(n)];
      const std::uint32_t gap = gapAt(column, height);
      const int next = column.first + int(gap - column.firstGap);
      if (next == column.last || m_heights[std::size_t(next)] != height) joinToGap(n, axis, false, gap);
    }
    for (int here = 0, there = 0;
         here <= column.last - column.first && there <= above->last - above->first;) {
      const auto [low, high] = extent(column, here);
      const auto [lowThere, highThere] = extent(*above, there);
      if (std::max(low, lowThere) <= std::min(high, highThere))
        m_connected.join(column.firstGap + std::uint32_t(here), above->firstGap + std::uint32_t(there));
      if (high < highThere)
        ++here;
      else
        ++there;
    }
  }

  void joinOutside(const Column& column, int axis, bool upper) {
    for (int n = column.first; n < column.last; ++n) joinToGap(n, axis, upper, kOutside);
    for (int gap = 0; gap <= column.last - column.first; ++gap) {
      const auto [low, high] = extent(column, gap);
      if (low <= high) m_connected.join(column.firstGap + std::uint32_t(gap), kOutside);
    }
  }

  const std::vector<CrossedLines>& m_crossed;
  std::vector<std::size_t> m_blocks;  // that are crossed, sorted by x, y and z
  std::vector<int> m_heights;         // theirs, in blocks
  std::vector<Parts> m_parts;
  std::vector<std::uint32_t> m_firstPart;  // as things that are connected
  std::vector<Column> m_columns;
  Connected m_connected{0};
};

}  // namespace

EnclosedCells enclosedCells(const sim::LeafTable& blocks, const std::vector<CrossedLines>& crossed) {
  return Division(blocks, crossed).enclosed(blocks);
}

}  // namespace fluidtex::caches
