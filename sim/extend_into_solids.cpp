// Based on: Aslam, "A partial differential equation approach to multidimensional extrapolation", 2004
// (constant and linear extension), solved upwind in the order of depth instead of in artificial time.
#include "sim/leaf_table.h"
#include "sim/level_set.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>

namespace fluidtex::sim {
namespace {

struct Extension {
  const LeafTable& table;
  const LetGo& letGo;
  float h;
  std::vector<float> value;         // #voxels: phi
  std::vector<float> depth;         // #voxels: -solidPhi
  std::vector<float> slope;         // #voxels: d(phi)/dn into the solid, as far as it may be used
  std::vector<std::uint8_t> known;  // #voxels

  // Slope of phi towards the solid at a cell in the open, from its neighbours away from the solid.
  double openSlope(std::int64_t cell) const {
    double slopeSum = 0.0, normalSquare = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      const std::int64_t below = table.neighbor(cell, 2 * axis), above = table.neighbor(cell, 2 * axis + 1);
      if (below < 0 || above < 0) continue;
      const double normal = static_cast<double>(depth[above]) - depth[below];
      const std::int64_t away = normal > 0.0 ? below : above;
      normalSquare += normal * normal;
      if (depth[away] <= kDeepInSolid * h)
        slopeSum += std::abs(normal) * (static_cast<double>(value[cell]) - value[away]);
    }
    return normalSquare > 0.0 ? slopeSum / (std::sqrt(normalSquare) * h) : 0.0;
  }

  // Slope of phi into the solid beyond a cell in the open, as far as it is believed.
  double usedSlope(std::int64_t solidCell, std::int64_t openCell) const {
    const bool away = letGo ? letGo(table.coord(openCell)) : value[solidCell] >= 0.0f;
    const double slopeThere = openSlope(openCell);
    if (value[openCell] < 0.0f) return std::clamp(slopeThere, -1.0, away ? 1.0 : 0.0);
    return away ? 0.0 : std::clamp(slopeThere, -1.0, 0.0);
  }

  bool extend(std::int64_t cell) {
    double weights = 0.0, squares = 0.0, sum = 0.0, slopes = 0.0;
    double plainSum = 0.0, plainSlopes = 0.0;
    int plainCount = 0;
    for (int axis = 0; axis < 3; ++axis) {
      double best = 0.0, bestValue = 0.0, bestSlope = 0.0;
      for (int up = 0; up < 2; ++up) {
        const std::int64_t n = table.neighbor(cell, 2 * axis + up);
        if (n < 0 || known[n] == 0) continue;
        double along = slope[n];
        if (depth[n] <= kDeepInSolid * h) along = usedSlope(cell, n);
        plainSum += value[n];
        plainSlopes += along;
        ++plainCount;
        const double shallower = static_cast<double>(depth[cell]) - depth[n];
        if (shallower > best) {
          best = shallower;
          bestValue = value[n];
          bestSlope = along;
        }
      }
      weights += best;
      squares += best * best;
      sum += best * bestValue;
      slopes += best * bestSlope;
    }
    if (plainCount == 0) return false;
    if (weights > 0.0) {
      slope[cell] = static_cast<float>(slopes / weights);
      value[cell] = static_cast<float>(sum / weights + slope[cell] * h * std::sqrt(squares) / weights);
    } else {
      slope[cell] = static_cast<float>(plainSlopes / plainCount);
      value[cell] = static_cast<float>(plainSum / plainCount);
    }
    known[cell] = 1;
    return true;
  }
};

struct Entry {
  float depth;
  std::int64_t cell;
  bool operator<(const Entry& other) const {
    return depth != other.depth ? depth < other.depth : cell < other.cell;
  }
};

}  // namespace

void extendIntoSolids(FloatGrid& phi, const FloatGrid& solidPhi, const LetGo& letGo) {
  const LeafTable table = makeLeafTable(phi.constTree());
  const float h = static_cast<float>(phi.voxelSize()[0]), background = phi.background();
  Extension extension{table,
                      letGo,
                      h,
                      sampleOn(table, phi.constTree()),
                      sampleOn(table, solidPhi.constTree()),
                      std::vector<float>(table.voxels()),
                      std::vector<std::uint8_t>(table.voxels())};
  std::vector<Entry> order;
  for (std::size_t n = 0; n < table.voxels(); ++n) {
    extension.depth[n] = -extension.depth[n];
    if (extension.depth[n] > kDeepInSolid * h) {
      order.push_back({extension.depth[n], static_cast<std::int64_t>(n)});
    } else {
      extension.known[n] = 1;
    }
  }
  if (order.empty()) return;
  tbb::parallel_sort(order.begin(), order.end());

  // Where the solid's distance ends, layers of equal depth wait for each other.
  std::vector<std::int64_t> waiting;
  for (const Entry& e : order) {
    if (!extension.extend(e.cell)) waiting.push_back(e.cell);
  }
  for (bool progress = true; progress && !waiting.empty();) {
    std::vector<std::int64_t> still;
    for (const std::int64_t cell : waiting) {
      if (!extension.extend(cell)) still.push_back(cell);
    }
    progress = still.size() < waiting.size();
    waiting.swap(still);
  }

  const auto leaves = leavesOf(phi.tree());
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    float* out = leaves[n]->buffer().data();
    for (int i = 0; i < kLeafSize; ++i) {
      out[i] = std::clamp(extension.value[n * kLeafSize + i], -background, background);
    }
  });
}

}  // namespace fluidtex::sim
