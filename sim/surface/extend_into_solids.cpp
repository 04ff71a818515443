// Based on: Aslam, "A partial differential equation approach to multidimensional extrapolation", 2004
// (constant and linear extension), solved upwind in the order of depth instead of in artificial time.
#include "sim/surface/extend_into_solids.h"

#include "sim/grid/leaf_table.h"
#include "sim/grid/voxel_mask.h"
#include "sim/solids/solid_layers.h"
#include "sim/solids/table_sight.h"
#include "sim/surface/level_set.h"
#include "sim/surface/mirror_sides.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>

namespace fluidtex::sim {
namespace {

using Vec3 = openvdb::Vec3f;

// A distance's slope is 1. Differences across a kink are steeper, by more than this.
constexpr float kKink = 0.01f;

// Mean of two differences beside each other, at most twice the smaller of them in magnitude: van Leer,
// "Towards the ultimate conservative difference scheme III", 1977 (monotonized central), but not 0 at an
// extremum.
float limitedMean(const std::array<float, 2>& change) {
  const auto [a, b] = change;
  const float most = 2.0f * std::min(std::abs(a), std::abs(b));
  return std::clamp(0.5f * (a + b), -most, most);
}

struct Extension {
  const LeafTable& table;
  const GapRules& rules;
  float deepest, h;                  // metres: cells deeper in solids than `deepest` get values
  std::vector<float> value;          // #voxels: phi
  std::vector<float> depth;          // #voxels: -solidPhi
  VoxelMask known;                   // cells with a value: all not deep in solids, and those extrapolated
  std::unique_ptr<Vec3[]> gradient;  // #voxels: of phi in solids, without the parts left out
  TableSight sight;

  // Whether a cell outside solids has a known neighbour outside solids along the axis. In a gap a cell wide
  // there is none, and nothing known of phi's slope across the gap.
  bool knowsSlope(std::int64_t cell, int axis) const {
    for (int up = 0; up < 2; ++up) {
      const std::int64_t n = sight.cell(cell, 2 * axis + up);
      if (n >= 0 && depth[n] <= deepest && isSet(known, n)) return true;
    }
    return false;
  }

  // Gradient of phi at a cell outside solids, from its known neighbours outside solids. Across a kink in air
  // it is that of the smoother side: beside the rim of a wall, phi behind it is the distance round the rim.
  Vec3 openGradient(std::int64_t cell) const {
    Vec3 slope(0.0f), limited(0.0f);
    for (int axis = 0; axis < 3; ++axis) {
      std::array<float, 2> change;  // in a cell, on either side
      int count = 0;
      for (int up = 0; up < 2; ++up) {
        const std::int64_t n = sight.cell(cell, 2 * axis + up);
        if (n < 0 || depth[n] > deepest || !isSet(known, n)) continue;
        change[count++] = (up != 0 ? value[n] - value[cell] : value[cell] - value[n]) / h;
      }
      if (count == 1) slope[axis] = limited[axis] = change[0];
      if (count == 2) {
        slope[axis] = 0.5f * (change[0] + change[1]);
        limited[axis] = limitedMean(change);
      }
    }
    if (value[cell] > 0.0f && slope.length() > 1.0f + kKink) slope = limited;
    const float length = slope.length();
    return length > 1.0f ? slope / length : slope;
  }

  // What one known neighbour gives for a cell in the solid. `normal`: into the solid there.
  struct Guess {
    float value;    // phi at the neighbour, or at this cell where `gradient` is 0
    Vec3 gradient;  // from the neighbour to this cell
    Vec3 carried;   // for cells still deeper
  };

  Guess ask(std::int64_t cell, std::int64_t from, const Vec3& normal) const {
    if (depth[from] > deepest) return {value[from], gradient[from], gradient[from]};
    const bool liquid = value[from] < 0.0f;
    const Vec3 slope = openGradient(from);
    const float inward = slope.dot(normal);
    const auto reachesLiquid = [&](float layers) { return value[from] + layers * h * inward < 0.0f; };
    // A surface that the wall cuts may leave air behind it even where the liquid stays at the wall.
    const auto away = [&] {
      return rules.opens ? rules.opens(table.coord(from))
                         : value[cell] >= 0.0f && (!liquid || inward > kAlongWall || reachesLiquid(1.0f));
    };
    // Air behind the solid's surface, which has moved with the flow since the liquid separated.
    if (liquid && away())
      return {rules.opens ? std::max(value[cell], depth[cell]) : value[cell], Vec3(0.0f), normal};
    const Vec3 along = slope - inward * normal;
    if (inward > kAlongWall) {
      // A gap of air stays where the surface does not come nearer.
      const bool stays = (!liquid && away()) || (rules.closes && !rules.closes(table.coord(from)));
      return {value[from], stays ? slope : along, stays ? slope : along};
    }
    if (liquid || !reachesLiquid(kSolidLayers) || !away()) return {value[from], slope, slope};
    // A film would form.
    return {value[from], reachesLiquid(1.0f) ? along : slope, along};
  }

  // The cell's value from its known neighbours that are less deep, each axis weighted by the difference in
  // depth; without such a neighbour, from all known ones. False where a less deep one is not known yet,
  // unless withoutNearest.
  bool extend(std::int64_t cell, bool withoutNearest) {
    std::array<std::int64_t, 3> nearest{-1, -1, -1};
    Vec3 way(0.0f);  // into the solid, by the differences in depth
    std::array<std::int64_t, 6> all;
    std::array<int, 6> side;  // on which side each of them is
    int count = 0;
    for (int axis = 0; axis < 3; ++axis) {
      for (int up = 0; up < 2; ++up) {
        const std::int64_t n = sight.cell(cell, 2 * axis + up);
        // A cell that a solid has left takes values from outside solids only, and a partly open cell none
        // from a closed one: what is extrapolated from deep in a wall may be liquid of its other side.
        if (n < 0 || (depth[cell] <= deepest && depth[n] > deepest)) continue;
        if (depth[cell] <= kDeepInSolid * h && depth[n] > kDeepInSolid * h) continue;
        const float shallower = depth[cell] - depth[n];
        if (!isSet(known, n)) {
          if (shallower > 0.0f && !withoutNearest) return false;
          continue;
        }
        side[count] = 2 * axis + up;
        all[count++] = n;
        if (shallower <= std::abs(way[axis])) continue;
        way[axis] = up != 0 ? -shallower : shallower;
        nearest[axis] = n;
      }
    }
    // No neighbour counts: the cell keeps its value, but becomes air where a solid has left it.
    if (count == 0) {
      if (withoutNearest && depth[cell] <= deepest) value[cell] = std::max(value[cell], h);
      return withoutNearest;
    }
    // Air that does not know the slope says nothing where others do that count at least as much: what lies
    // across a gap may be the liquid beside it, of a level just below the gap's floor.
    Vec3 told(0.0f);
    for (int axis = 0; axis < 3; ++axis) {
      const std::int64_t n = nearest[axis];
      if (n >= 0 && (depth[n] > deepest || value[n] < 0.0f || knowsSlope(n, axis))) told[axis] = way[axis];
    }
    if (2.0f * told.lengthSqr() >= way.lengthSqr()) way = told;
    for (int axis = 0; axis < 3; ++axis)
      if (way[axis] == 0.0f) nearest[axis] = -1;
    const float length = way.length();
    const Vec3 normal = length > 0.0f ? way / length : Vec3(0.0f);
    float weights = 0.0f, sum = 0.0f;
    float air =
        std::numeric_limits<float>::infinity();  // least of those used, where all are air in the solid
    const auto note = [&](std::int64_t from) {
      air = depth[from] > deepest && value[from] >= 0.0f ? std::min(air, value[from]) : -1.0f;
    };
    Vec3 carried(0.0f);
    for (int axis = 0; axis < 3; ++axis) {
      if (nearest[axis] < 0) continue;
      const Guess guess = ask(cell, nearest[axis], normal);
      note(nearest[axis]);
      const float weight = std::abs(way[axis]);
      weights += weight;
      sum += weight * (guess.value - value[all[0]]) + way[axis] * h * guess.gradient[axis];
      carried += weight * guess.carried;
    }
    for (int n = 0; length == 0.0f && n < count; ++n) {
      const Guess guess = ask(cell, all[n], normal);
      note(all[n]);
      const float step = side[n] % 2 == 0 ? h : -h;
      weights += 1.0f;
      sum += guess.value - value[all[0]] + step * guess.gradient[side[n] / 2];
      carried += guess.carried;
    }
    // The mean of equal values must be exact: values that differ from the background by rounding would make
    // leaves of nothing else, and those more leaves along the edges between walls.
    value[cell] = value[all[0]] + sum / weights;
    // A slope of phi in air makes no surface in a partly open cell: the surface may be behind the solid.
    if (air >= 0.0f && value[cell] < 0.0f && depth[cell] <= kDeepInSolid * h) value[cell] = air;
    gradient[cell] = carried / weights;
    return true;
  }
};

}  // namespace

void extendIntoSolids(FloatGrid& phi, const FloatGrid& solidPhi, const GapRules& rules, float deep,
                      const Visibility* visibility, const FloatGrid* left) {
  const LeafTable table = makeLeafTable(phi.constTree());
  const float h = static_cast<float>(phi.voxelSize()[0]), background = phi.background();
  Extension extension{table,
                      rules,
                      deep * h,
                      h,
                      sampleOn(table, phi.constTree()),
                      sampleOn(table, solidPhi.constTree()),
                      {},
                      nullptr,
                      TableSight(table, visibility)};
  forLeaves(table, [&](std::size_t n) {
    for (std::size_t i = n * kLeafSize; i < (n + 1) * kLeafSize; ++i)
      extension.depth[i] = -extension.depth[i];
  });
  extension.known = maskOf(table, extension.depth, [&](float d) { return !(d > extension.deepest); });
  if (left != nullptr) {
    const VoxelMask was =
        maskOf(table, sampleOn(table, left->constTree()), [&](float d) { return d >= -extension.deepest; });
    for (std::size_t n = 0; n < table.size(); ++n)
      for (std::size_t i = 0; i < was[n].size(); ++i) extension.known[n][i] &= was[n][i];
  }
  std::vector<std::size_t> open;  // leaves with cells that are not known yet
  for (std::size_t n = 0; n < table.size(); ++n)
    if (!allSet(extension.known[n])) open.push_back(n);
  if (open.empty()) return;
  extension.gradient = std::make_unique<Vec3[]>(table.voxels());

  // From outside inwards, all cells beside known ones at once.
  bool progress = true, withoutNearest = false;
  while (!open.empty() && (progress || !withoutNearest)) {
    // Cells that wait for each other are solved without their less deep neighbours.
    withoutNearest = !progress;
    std::vector<LeafBits> found(open.size());
    tbb::parallel_for(std::size_t{0}, open.size(), [&](std::size_t n) {
      LeafBits next = besideAny(table, extension.known, open[n]);
      for (std::size_t i = 0; i < next.size(); ++i) next[i] &= ~extension.known[open[n]][i];
      forBits(next, open[n], [&](std::int64_t cell) {
        if (extension.extend(cell, withoutNearest)) setBit(found[n], cell);
      });
    });
    progress = false;
    for (std::size_t n = 0; n < open.size(); ++n) {
      for (std::size_t i = 0; i < found[n].size(); ++i) {
        extension.known[open[n]][i] |= found[n][i];
        progress = progress || found[n][i] != 0;
      }
    }
    std::erase_if(open, [&](std::size_t leaf) { return allSet(extension.known[leaf]); });
  }

  const auto leaves = leavesOf(phi.tree());
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    float* out = leaves[n]->buffer().data();
    for (int i = 0; i < kLeafSize; ++i) {
      out[i] = std::clamp(extension.value[n * kLeafSize + i], -background, background);
    }
  });
}

void extendBeyond(FloatGrid& phi, const SolidField& solid, const GapRules& rules, float deep,
                  const FloatGrid* left) {
  extendIntoSolids(phi, *solid.phi, rules, deep, solid.visibility.get(), left);
  mirrorAtSides(phi, solid);
}

}  // namespace fluidtex::sim
