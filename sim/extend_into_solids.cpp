// Based on: Aslam, "A partial differential equation approach to multidimensional extrapolation", 2004
// (constant and linear extension), solved upwind in the order of depth instead of in artificial time.
#include "sim/leaf_table.h"
#include "sim/level_set.h"
#include "sim/sort_by_distance.h"

#include <tbb/parallel_for.h>

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

  // What one known neighbour says about a cell in the solid.
  struct Guess {
    double value;    // phi at the neighbour, or here where `slope` is no part of it
    double slope;    // to be added for this cell
    double carried;  // to be used by cells still deeper
  };

  Guess ask(std::int64_t cell, std::int64_t from) const {
    if (depth[from] > kDeepInSolid * h) return {value[from], slope[from], slope[from]};
    const bool liquid = value[from] < 0.0f;
    const bool away = letGo ? letGo(table.coord(from)) : value[cell] >= 0.0f;
    // Air behind the solid's surface, which has moved with the flow since the liquid let go.
    if (liquid && away) return {std::max(value[cell], depth[cell]), 0.0, 1.0};
    const double used = !liquid && away ? 0.0 : std::clamp(openSlope(from), -1.0, 0.0);
    return {value[from], used, used};
  }

  // The cell's value from its known neighbours nearer to the open, each axis weighted by how much nearer;
  // with no such neighbour, from all known ones. False where none is known.
  bool extend(std::int64_t cell) {
    double weights = 0.0, squares = 0.0, sum = 0.0, slopes = 0.0, carried = 0.0;
    double plainSum = 0.0, plainCarried = 0.0;
    int plainCount = 0;
    for (int axis = 0; axis < 3; ++axis) {
      double best = 0.0;
      Guess bestGuess{};
      for (int up = 0; up < 2; ++up) {
        const std::int64_t n = table.neighbor(cell, 2 * axis + up);
        if (n < 0 || known[n] == 0) continue;
        const Guess guess = ask(cell, n);
        plainSum += guess.value;
        plainCarried += guess.carried;
        ++plainCount;
        const double shallower = static_cast<double>(depth[cell]) - depth[n];
        if (shallower > best) {
          best = shallower;
          bestGuess = guess;
        }
      }
      weights += best;
      squares += best * best;
      sum += best * bestGuess.value;
      slopes += best * bestGuess.slope;
      carried += best * bestGuess.carried;
    }
    if (plainCount == 0) return false;
    if (weights > 0.0) {
      value[cell] = static_cast<float>((sum + slopes / weights * h * std::sqrt(squares)) / weights);
      slope[cell] = static_cast<float>(carried / weights);
    } else {
      value[cell] = static_cast<float>(plainSum / plainCount);
      slope[cell] = static_cast<float>(plainCarried / plainCount);
    }
    known[cell] = 1;
    return true;
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
  std::vector<FarVoxel> order;
  for (std::size_t n = 0; n < table.voxels(); ++n) {
    extension.depth[n] = -extension.depth[n];
    if (extension.depth[n] > kDeepInSolid * h) {
      order.push_back({sortKey(extension.depth[n]), static_cast<std::uint32_t>(n)});
    } else {
      extension.known[n] = 1;
    }
  }
  if (order.empty()) return;
  sortByDistance(order);

  // Where the solid's distance ends, layers of equal depth wait for each other.
  std::vector<std::int64_t> waiting;
  for (const FarVoxel& e : order) {
    if (!extension.extend(e.voxel)) waiting.push_back(e.voxel);
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
