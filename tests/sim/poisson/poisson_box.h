// Poisson systems of a box of cells, in one part or in two.
#pragma once

#include "sim/poisson/poisson.h"

#include <random>
#include <vector>

namespace fluidtex::sim {

// Cells of a box of n^3 for which `inside` holds, linked by random openness; anchored where the box ends
// above.
inline PoissonSystem systemOf(int n, bool (*inside)(const Coord&), bool anchored = true) {
  std::vector<CellBlock> blocks;
  for (int i = 0; i < n; i += 8) {
    for (int j = 0; j < n; j += 8) {
      for (int k = 0; k < n; k += 8) {
        CellBlock block;
        block.origin = Coord(i, j, k);
        for (int c = 0; c < 512; ++c) {
          const Coord cell = block.origin.offsetBy(c >> 6, (c >> 3) & 7, c & 7);
          block.cells[c] = cell[0] < n && cell[1] < n && cell[2] < n && inside(cell);
        }
        if (block.cells.any()) blocks.push_back(block);
      }
    }
  }
  PoissonSystem system;
  system.numbering = CellNumbering(blocks);
  const int size = system.numbering.size();
  system.rows.resize(size);
  system.anchor.assign(size, 0.0);
  system.anchoredSides.assign(size, 0);
  std::mt19937 random(5);
  std::uniform_real_distribution<float> openness(0.01f, 1.0f);
  for (int i = 0; i < size; ++i) {
    for (int s = 0; s < kSides; ++s) {
      Coord beside = system.numbering.cell(i);
      beside[s >> 1] += (s & 1) ? 1 : -1;
      const int neighbor = system.numbering.at(beside);
      system.rows.neighbor[i][s] = neighbor < 0 ? size : neighbor;
      if (neighbor < 0) {
        system.rows.link[i][s] = 0.0f;
      } else if (neighbor > i) {
        system.rows.link[i][s] = openness(random);
      } else {
        system.rows.link[i][s] = system.rows.link[neighbor][s ^ 1];
      }
    }
    if (anchored && system.numbering.cell(i)[2] == n - 1) {
      system.anchor[i] = 2.0;
      system.anchoredSides[i] = 1 << 5;
    }
  }
  return system;
}

inline bool everywhere(const Coord&) {
  return true;
}
inline bool twoRooms(const Coord& c) {
  return c[0] != 9;
}

}  // namespace fluidtex::sim
