#include "sim/pressure/pressure_system.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace fluidtex::sim {

using Range = tbb::blocked_range<int>;

PoissonSystem pressureSystem(const LiquidCells& liquid, const std::vector<char>& detached,
                             std::vector<int>& liquidOf) {
  PoissonSystem system;
  system.numbering = liquid.numbering;
  if (std::find(detached.begin(), detached.end(), 1) != detached.end()) {
    std::vector<CellBlock> blocks = liquid.blocks;
    for (CellBlock& block : blocks) {
      const int* numbers = liquid.numbering.block(block.origin);
      for (int c = 0; c < kLeafSize; ++c) {
        if (numbers[c] >= 0 && detached[numbers[c]]) block.cells.reset(c);
      }
    }
    std::erase_if(blocks, [](const CellBlock& block) { return block.cells.none(); });
    system.numbering = CellNumbering(blocks);
  }
  const int n = system.numbering.size();
  system.rows.resize(n);
  system.anchor.assign(n, 0.0);
  system.anchoredSides.assign(n, 0);
  liquidOf.resize(n);
  tbb::parallel_for(Range(0, static_cast<int>(liquid.blocks.size())), [&](const Range& range) {
    for (int b = range.begin(); b < range.end(); ++b) {
      const BlockNumbers all(liquid.numbering, liquid.blocks[b].origin);
      const BlockNumbers numbers(system.numbering, liquid.blocks[b].origin);
      for (int c = 0; c < kLeafSize; ++c) {
        const int i = numbers.at(c);
        if (i < 0) continue;
        liquidOf[i] = all.at(c);
        const LiquidSides& cell = liquid.sidesOf(liquidOf[i]);
        for (int s = 0; s < kSides; ++s) {
          const int neighbor = numbers.beside(c, s);
          const bool linked = cell.open[s] > 0.0f && neighbor >= 0;
          system.rows.neighbor[i][s] = linked ? neighbor : n;
          system.rows.link[i][s] = linked ? cell.open[s] : 0.0f;
          if (cell.open[s] > 0.0f && !linked) {
            // The surface, or a detached cell with pressure 0 at its centre.
            system.anchor[i] +=
                static_cast<double>(cell.open[s]) / (cell.theta[s] > 0.0f ? cell.theta[s] : 1.0f);
            system.anchoredSides[i] |= static_cast<std::uint8_t>(1 << s);
          }
        }
      }
    }
  });
  return system;
}

}  // namespace fluidtex::sim
