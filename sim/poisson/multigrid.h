// A symmetric V-cycle for Poisson systems: the preconditioner of solvePoisson.
#pragma once

#include "sim/poisson/poisson.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace fluidtex::sim {

class Multigrid {
 public:
  // Builds the coarse levels. The system must outlive the object. even: of its rows.
  Multigrid(const PoissonSystem& system, const EvenRows& even);

  // x = M b with M symmetric and an approximate inverse of the system's matrix. Single precision; b of
  // magnitude about 1. Both hold size() + 1 values, the last one 0.
  void apply(const std::vector<float>& b, std::vector<float>& x);

 private:
  // A cell, one of the first 2^30, and how many quarters of its value count, 1 to 4.
  class Share {
   public:
    Share() = default;
    Share(int cell, int quarters) : m_packed(static_cast<std::uint32_t>(cell) << 2 | (quarters - 1)) {}
    int cell() const { return static_cast<int>(m_packed >> 2); }
    int quarters() const { return static_cast<int>(m_packed & 3) + 1; }
    float weight() const { return 0.25f * static_cast<float>(quarters()); }

   private:
    std::uint32_t m_packed = 0;
  };
  // From this level's red cells to the next coarser level: what the cell's own parent counts, and 1/4 for
  // each of three neighbours of the parent (the coarse level's size where there is none).
  struct Interpolation {
    Share own;
    std::array<int, 3> others;
  };
  struct Level {
    CellNumbering ownNumbering;
    PoissonRows ownRows;
    // Its own, or the system's on the finest level.
    const CellNumbering* numbering = nullptr;
    const PoissonRows* rows = nullptr;
    EvenRows even;
    std::vector<float> inverseDiagonal;
    std::vector<double> ownAnchor;
    std::vector<std::uint8_t> ownAnchoredSides;
    const std::vector<double>* anchor = nullptr;
    const std::vector<std::uint8_t>* anchoredSides = nullptr;
    std::vector<Interpolation> interpolation;  // of red cells
    // The transpose, for the cells of the next coarser level: in groups of successive cells, and where those
    // of a cell end in its group.
    std::vector<std::vector<Share>> entries;
    std::vector<int> entryEnd;
    std::vector<float> b, x, residual;  // b, x unused on the finest level
  };

  static std::unique_ptr<Level> coarsen(const Level& fine, int depth);
  static void connect(Level& fine, const Level& coarse, int depth);
  void cycle(std::size_t depth, const std::vector<float>& b, std::vector<float>& x);

  std::vector<std::unique_ptr<Level>> m_levels;
};

}  // namespace fluidtex::sim
