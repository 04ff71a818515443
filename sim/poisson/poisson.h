// Seven-point Poisson systems on scattered cells of a grid, solved by conjugate gradients with a multigrid
// preconditioner.
#pragma once

#include "numerics/block_table.h"

#include <openvdb/math/Coord.h>

#include <algorithm>
#include <array>
#include <bitset>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace fluidtex::sim {

class Multigrid;

using openvdb::math::Coord;

// Sides of a cell, in this order everywhere: -x +x -y +y -z +z. side ^ 1 is the opposite one.
inline constexpr int kSides = 6;

// Some cells of one 8x8x8 block whose origin is a multiple of 8; bit 64 i + 8 j + k.
struct CellBlock {
  Coord origin{0};
  std::bitset<512> cells;
};

// Numbers the cells of a list of blocks: first all with even i+j+k ("red"), then the others ("black"), each
// in the order of the blocks. Copies share the lists. Memory follows the blocks, wherever they lie: they are
// found through tables of 4 x 4 x 4, and those through a hash.
class CellNumbering {
 public:
  CellNumbering() = default;
  explicit CellNumbering(const std::vector<CellBlock>& blocks);

  int size() const { return static_cast<int>(m_lists->places.size()); }
  int redCount() const { return m_red; }
  Coord cell(int number) const {
    const int place = m_lists->places[number], c = place & 511;
    return m_lists->origins[place >> 9].offsetBy(c >> 6, (c >> 3) & 7, c & 7);
  }
  const std::vector<Coord>& origins() const { return m_lists->origins; }  // of the blocks, as they were given

  // Indices of a block's 512 cells (-1: not in the list), or null where the block has none.
  const int* block(const Coord& anyCellInside) const {
    const std::uint32_t table = m_lists->tables.find(anyCellInside >> 5);
    if (table == BlockTable::kNone) return nullptr;
    const int start = m_lists->blockStart[64 * std::size_t(table) + placeInTable(anyCellInside)];
    return start < 0 ? nullptr : m_lists->numbers.data() + start;
  }

  // Index of a cell; -1 where it is not in the list.
  int at(const Coord& cell) const {
    const int* numbers = block(cell);
    return numbers == nullptr ? -1 : numbers[((cell[0] & 7) << 6) | ((cell[1] & 7) << 3) | (cell[2] & 7)];
  }

 private:
  static int placeInTable(const Coord& cell) {
    return (((cell[0] >> 3) & 3) << 4) | (((cell[1] >> 3) & 3) << 2) | ((cell[2] >> 3) & 3);
  }

  struct Lists {
    std::vector<Coord> origins;
    std::vector<int> places;      // of the cells: 512 times the block's, and which of its 512
    BlockTable tables;            // by their lowest cell / 32
    std::vector<int> blockStart;  // into numbers, by table and block in it; -1: no cells
    std::vector<int> numbers;
  };

  int m_red = 0;
  std::shared_ptr<Lists> m_lists = std::make_shared<Lists>();
};

// Indices in a block and in those beside it.
class BlockNumbers {
 public:
  BlockNumbers(const CellNumbering& numbering, const Coord& origin);

  // Of the block's cell 64 i + 8 j + k; -1: not one of them.
  int at(int cell) const { return m_own == nullptr ? -1 : m_own[cell]; }
  int beside(int cell, int side) const {
    const int shift = 6 - 3 * (side >> 1), up = side & 1;
    if (((cell >> shift) & 7) != (up != 0 ? 7 : 0))
      return at(up != 0 ? cell + (1 << shift) : cell - (1 << shift));
    const int* there = m_beside[side];
    return there == nullptr ? -1 : there[up != 0 ? cell - (7 << shift) : cell + (7 << shift)];
  }

 private:
  const int* m_own;
  std::array<const int*, kSides> m_beside;
};

// The rows of the matrix:  (sum of links + anchor) x_i - sum over sides of link x_neighbor.
struct PoissonRows {
  std::vector<std::array<int, kSides>> neighbor;  // size() of the numbering where there is none, its link 0
  std::vector<std::array<float, kSides>> link;    // not negative; the same seen from both cells

  std::size_t size() const { return neighbor.size(); }
  void resize(std::size_t n) {
    neighbor.resize(n);
    link.resize(n);
  }
};

// Rows in the liquid's interior are equal. Even rows are groups of 32 successive cells whose links have one
// value and which have no anchor. Sums over their neighbours need not read the links, which halves the memory
// traffic.
class EvenRows {
 public:
  EvenRows() = default;
  EvenRows(const PoissonRows& rows, const std::vector<double>& anchor);

  // Calls even(first, last, link) and mixed(first, last) for the parts of [begin, end).
  template <class Even, class Mixed>
  void forParts(int begin, int end, const Even& even, const Mixed& mixed) const {
    while (begin < end) {
      const int part = begin >> kShift, last = std::min(end, (part + 1) << kShift);
      if (m_link[part] > 0.0f) {
        even(begin, last, m_link[part]);
      } else {
        mixed(begin, last);
      }
      begin = last;
    }
  }

 private:
  static constexpr int kShift = 5;
  std::vector<float> m_link;  // of 32 cells; 0 where they are not alike
};

// Symmetric, positive (semi)definite. Anchors tie cells to the value 0. A connected part without one is
// singular; it is solved with the means over that part subtracted from right-hand side and unknowns.
struct PoissonSystem {
  CellNumbering numbering;
  PoissonRows rows;
  std::vector<double> anchor;
  std::vector<std::uint8_t> anchoredSides;  // bit s: part of the anchor is on side s
};

struct PoissonReport {
  bool converged = false;
  int iterations = 0;
  double residual = 0.0;  // 2-norm relative to the right-hand side's
  bool ended = false;     // by the probe
};

// Connected parts without an anchor, each a list of its cells.
std::vector<std::vector<int>> singularParts(const PoissonSystem& system);

// Called once, when the residual has fallen to `tolerance`: whether the solve continues from there (early
// termination).
struct PoissonProbe {
  double tolerance = 0.0;
  std::function<bool(const std::vector<double>& x)> continues;
};

// Solver of one system for several right-hand sides; the preconditioner is built once. The system and its
// singular parts must outlive the object.
class PoissonSolver {
 public:
  PoissonSolver(const PoissonSystem& system, const std::vector<std::vector<int>>& singular);
  ~PoissonSolver();
  PoissonSolver(const PoissonSolver&) = delete;
  PoissonSolver& operator=(const PoissonSolver&) = delete;

  // Starts from the given x. Ends when the 2-norm of the residual falls to `tolerance` times that of b, or by
  // the probe.
  [[nodiscard]] PoissonReport solve(std::vector<double> b, std::vector<double>& x, double tolerance,
                                    int maxIterations, const PoissonProbe& probe = {});

 private:
  const PoissonSystem& m_system;
  const std::vector<std::vector<int>>& m_singular;
  EvenRows m_even;
  std::unique_ptr<Multigrid> m_preconditioner;  // null until one is needed
};

// The same for a single right-hand side.
[[nodiscard]] PoissonReport solvePoisson(const PoissonSystem& system,
                                         const std::vector<std::vector<int>>& singular, std::vector<double> b,
                                         std::vector<double>& x, double tolerance, int maxIterations);

}  // namespace fluidtex::sim
