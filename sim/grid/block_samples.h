// A field around one block of 8 x 8 x 8 cells, as markers read it.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/grid/trilinear.h"

#include <array>
#include <cmath>
#include <vector>

namespace fluidtex::sim {

// Values of a box around a block, sampled in the block's own coordinates.
struct BlockSamples {
  int halo, side;
  std::vector<float> value;

  explicit BlockSamples(int width) { setHalo(width); }

  // Before load().
  void setHalo(int width) {
    halo = width;
    side = kLeafDim + 2 * width;
    value.resize(std::size_t(side) * side * side);
  }

  void load(const FloatTree& tree, const Coord& origin, float scale = 1.0f) {
    gather(tree, origin, halo, value.data());
    if (scale == 1.0f) return;
    for (float& v : value) v *= scale;
  }

  // The sample at i, j, k.
  const float* sample(int i, int j, int k) const {
    return value.data() + ((i + halo) * side + j + halo) * std::ptrdiff_t(side) + k + halo;
  }

  // Places lie `halo` cells outside the block at most.
  float at(float x, float y, float z) const {
    const float fromX = x + float(halo), fromY = y + float(halo), fromZ = z + float(halo);
    const int i = int(fromX), j = int(fromY), k = int(fromZ);
    const float* p = value.data() + (i * side + j) * std::ptrdiff_t(side) + k;
    return trilinear(p, std::ptrdiff_t(side) * side, side, fromX - float(i), fromY - float(j),
                     fromZ - float(k));
  }

  // Whether one of the eight values around is negative.
  bool anyNegative(float x, float y, float z) const {
    const float* p = sample(int(std::floor(x)), int(std::floor(y)), int(std::floor(z)));
    for (int n = 0; n < 8; ++n)
      if (p[((n >> 2) * side + ((n >> 1) & 1)) * std::ptrdiff_t(side) + (n & 1)] < 0.0f) return true;
    return false;
  }
};

// The range of the values at the eight corners of each of a block's cells, which bounds all samples in the
// cell.
struct CellRanges {
  std::array<float, kLeafSize> low, high;

  // By rounding a marker's sample may exceed the range by this.
  static constexpr float kRounding = 1e-4f;

  void find(const BlockSamples& samples) {
    constexpr int kPoints = kLeafDim + 1;
    // Along z, then y, then x.
    float lowZ[kPoints][kPoints][kLeafDim], highZ[kPoints][kPoints][kLeafDim];
    for (int i = 0; i < kPoints; ++i) {
      for (int j = 0; j < kPoints; ++j) {
        const float* p = samples.sample(i, j, 0);
        for (int k = 0; k < kLeafDim; ++k) {
          lowZ[i][j][k] = p[k] < p[k + 1] ? p[k] : p[k + 1];
          highZ[i][j][k] = p[k] > p[k + 1] ? p[k] : p[k + 1];
        }
      }
    }
    const auto least = [](float a, float b) { return a < b ? a : b; };
    const auto most = [](float a, float b) { return a > b ? a : b; };
    for (int i = 0; i < kLeafDim; ++i) {
      for (int j = 0; j < kLeafDim; ++j) {
        for (int k = 0; k < kLeafDim; ++k) {
          const int at = 64 * i + 8 * j + k;
          low[at] =
              least(least(lowZ[i][j][k], lowZ[i][j + 1][k]), least(lowZ[i + 1][j][k], lowZ[i + 1][j + 1][k]));
          high[at] = most(most(highZ[i][j][k], highZ[i][j + 1][k]),
                          most(highZ[i + 1][j][k], highZ[i + 1][j + 1][k]));
        }
      }
    }
  }
};

}  // namespace fluidtex::sim
