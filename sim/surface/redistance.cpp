// Cells near the surface get their distance from the closest point on it (sim/surface/surface_distance.h).
// The equation  d(phi)/dtau = sign(phi0) (1 - |grad phi|)  of Sussman, Smereka and Osher 1994 spreads it from
// there. It also serves beside corners, films and gaps, where no smooth surface has a closest point, with:
// Russo and Smereka, "A remark on computing distance functions", 2000 (the surface's place kept within
// cells); Min, "On reinitializing level set functions", 2010 (second-order differences, quadratic place,
// local steps).
#include "sim/surface/redistance.h"

#include "sim/grid/leaf_block.h"
#include "sim/grid/leaf_table.h"
#include "sim/solids/solid_layers.h"
#include "sim/surface/level_set.h"
#include "sim/surface/mirror_sides.h"
#include "sim/surface/surface_distance.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace fluidtex::sim {
namespace {

using FluxBlock = LeafBlock<2>;
constexpr int kBlock = FluxBlock::kCount;
constexpr float kCourant = kRedistanceReach;

// Cells beside the surface whose error is less than this share of a cell keep their value: a surface at rest
// does not move at all, however often it is reinitialised.
constexpr float kRightEnough = 1e-3f;

// Cells closer to the surface than this, in cells, keep their value too: their local step would be too short.
constexpr float kClosest = 1e-3f;

// Nearer to solids than this, in cells, the surface does not count as smooth: phi is extrapolated behind
// them.
constexpr float kAwayFromSolids = 2.9f;

// By value and without branches, so that loops over them vectorise.
inline float least(float a, float b) {
  return a < b ? a : b;
}
inline float most(float a, float b) {
  return a > b ? a : b;
}
inline float minmod(float a, float b) {
  return most(0.0f, least(a, b)) + least(0.0f, most(a, b));
}

// A cell next to the surface, and the distances to the surface towards -x, +x, -y, ... in units of h (1 where
// it is farther).
struct NearCell {
  int offset;
  std::array<float, 6> reach;
  const VisibleCells* visible = nullptr;  // null where all is visible
};

// The values around a cell along each axis, as they are stored.
struct StoredValues {
  const float* p;
  float operator()(int axis, int steps) const { return p[steps * FluxBlock::kStride[axis]]; }
};

// The same, with only the cell's side of thin walls.
struct OneSidedValues {
  std::array<std::array<float, 5>, 3> value;
  float operator()(int axis, int steps) const { return value[axis][steps + 2]; }

  OneSidedValues(const float* p, const VisibleCells& visible) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto sees = [&](int steps) {
        return visible.sees(VisibleCells::kMiddle + steps * VisibleCells::kStride[axis]);
      };
      auto& v = value[axis];
      for (int steps = -2; steps <= 2; ++steps) v[steps + 2] = p[steps * FluxBlock::kStride[axis]];
      // Neither a surface nor a slope is taken from behind the wall.
      if (!sees(-1)) v[1] = v[2];
      if (!sees(1)) v[3] = v[2];
      if (!sees(-2)) v[0] = 2.0f * v[1] - v[2];
      if (!sees(2)) v[4] = 2.0f * v[3] - v[2];
    }
  }
};

// Where the ENO parabola through phi vanishes between two cells (0: at the first) [Min10 eq. 9].
float crossing(float before, float here, float there, float after) {
  const float curvature = minmod(before - 2.0f * here + there, here - 2.0f * there + after);
  const float linear = here / (here - there);
  // A flatter parabola than this is a line within float precision.
  if (std::abs(curvature) < 1e-4f * std::abs(here - there)) return linear;
  const float half = 0.5f * curvature - here - there;
  const float root = std::sqrt(std::max(0.0f, half * half - 4.0f * here * there));
  const float side = here > there ? 1.0f : -1.0f;
  return 0.5f + (here - there - side * root) / curvature;
}

// Fills in the distances to the surface; false where it is next to the cell on no side.
template <class Values>
bool findSurface(const Values& at, NearCell& cell) {
  bool near = false;
  for (int direction = 0; direction < 6; ++direction) {
    const int axis = direction >> 1, out = (direction & 1) != 0 ? 1 : -1;
    const float here = at(axis, 0), there = at(axis, out);
    if ((here < 0.0f) == (there < 0.0f)) continue;
    near = true;
    cell.reach[direction] = std::clamp(crossing(at(axis, -out), here, there, at(axis, 2 * out)), 0.0f, 1.0f);
  }
  return near;
}

std::vector<NearCell> nearCells(const float* block, const Visibility::Leaf* visibility) {
  std::vector<NearCell> cells;
  for (int offset = 0; offset < kLeafSize; ++offset) {
    const float* p = block + FluxBlock::index(offset);
    NearCell cell{offset, {1.0f, 1.0f, 1.0f, 1.0f, 1.0f, 1.0f}};
    if (visibility != nullptr && !(*visibility)[offset].seesAll()) cell.visible = &(*visibility)[offset];
    if (cell.visible != nullptr ? findSurface(OneSidedValues(p, *cell.visible), cell)
                                : findSurface(StoredValues{p}, cell))
      cells.push_back(cell);
  }
  return cells;
}

// Godunov's choice of one-sided slopes, squared; side: 1 where phi is positive, -1 inside.
inline float upwindSquare(float minus, float plus, float side) {
  const float upwind = most(0.0f, most(side * minus, -side * plus));
  return upwind * upwind;
}

// |grad phi|^2 of a regular cell's row of 8, second-order ENO. Inlined, it is not vectorised.
[[gnu::noinline]] void addSlopes(const float* __restrict block, int stride, float* __restrict square) {
  for (int i = 0; i < kLeafDim; ++i) {
    for (int j = 0; j < kLeafDim; ++j) {
      const float* p = block +
                       ((i + FluxBlock::kHalo) * FluxBlock::kSide + j + FluxBlock::kHalo) * FluxBlock::kSide +
                       FluxBlock::kHalo;
      float* out = square + 64 * i + 8 * j;
      for (int k = 0; k < kLeafDim; ++k) {
        const float m2 = p[k - 2 * stride], m1 = p[k - stride], c = p[k];
        const float p1 = p[k + stride], p2 = p[k + 2 * stride];
        const float below = m2 - 2.0f * m1 + c, here = m1 - 2.0f * c + p1, above = c - 2.0f * p1 + p2;
        const float minus = c - m1 + 0.5f * minmod(here, below);
        const float plus = p1 - c - 0.5f * minmod(here, above);
        out[k] += upwindSquare(minus, plus, c < 0.0f ? -1.0f : 1.0f);
      }
    }
  }
}

// The same for one cell; next to the surface differences end at it, where phi is 0.
template <class Values>
float slopeAt(const Values& at, const NearCell& cell) {
  float square = 0.0f;
  for (int axis = 0; axis < 3; ++axis) {
    const float m2 = at(axis, -2), m1 = at(axis, -1), c = at(axis, 0), p1 = at(axis, 1), p2 = at(axis, 2);
    const float below = m2 - 2.0f * m1 + c, here = m1 - 2.0f * c + p1, above = c - 2.0f * p1 + p2;
    const float left = cell.reach[2 * axis], right = cell.reach[2 * axis + 1];
    const bool crossLeft = (c < 0.0f) != (m1 < 0.0f), crossRight = (c < 0.0f) != (p1 < 0.0f);
    const float minus = (crossLeft ? c / left : c - m1) + 0.5f * left * minmod(here, below);
    const float plus = (crossRight ? -c / right : p1 - c) - 0.5f * right * minmod(here, above);
    square += upwindSquare(minus, plus, c < 0.0f ? -1.0f : 1.0f);
  }
  return square;
}

struct LeafPlan {
  std::vector<NearCell> near;       // those whose distance comes from the iteration
  std::vector<NearCell> oneSided;   // others that have cells around them hidden by walls
  std::vector<std::int16_t> held;   // offsets of cells that the iteration leaves alone
  std::vector<CellDistance> moved;  // those of them that get a new value beforehand

  bool rests() const { return held.size() == kLeafSize; }
};

// Whether a cell beside a surface that is not smooth is left alone; too far a one is moved. A surface through
// the places where it crosses the axes is at most as far as the nearest of them, and at least as far as a
// plane through all. Any value between may be right, and that of a corner is. The iteration makes the plane
// of it, in the next call a plane through the new crossings, and so on: corners would wear away.
bool keepCorner(const NearCell& cell, const float* p, float h, std::vector<CellDistance>& moved) {
  const float nearest = *std::min_element(cell.reach.begin(), cell.reach.end());
  if (std::abs(*p) <= nearest * h) return slopeAt(StoredValues{p}, cell) >= h * h;
  moved.push_back({static_cast<std::int16_t>(cell.offset), *p < 0.0f ? -nearest : nearest});
  return true;
}

LeafPlan planLeaf(const FloatTree& phi, const FloatTree& solidPhi, const Coord& origin, float h,
                  const Visibility::Leaf* visibility) {
  float scratch[kLeafSize];
  const float* solid = leafValues(solidPhi, origin, scratch);
  const float deepest = -kDeepInSolid * h;
  std::array<bool, kLeafSize> held;
  for (int i = 0; i < kLeafSize; ++i) held[i] = solid[i] < deepest;
  LeafPlan plan;
  if (std::all_of(held.begin(), held.end(), std::identity{})) {
    plan.held.resize(kLeafSize);
    return plan;
  }
  static thread_local float block[kBlock];  // 0 where nothing is gathered
  gather(phi, origin, FluxBlock::kHalo, block, true);
  plan.near = nearCells(block, visibility);
  for (const NearCell& cell : plan.near) {
    if (*std::min_element(cell.reach.begin(), cell.reach.end()) < kClosest) held[cell.offset] = true;
  }
  std::array<bool, kLeafSize> notAsked;
  for (int i = 0; i < kLeafSize; ++i) {
    notAsked[i] = solid[i] < kAwayFromSolids * h || (visibility != nullptr && !(*visibility)[i].seesAll());
  }
  for (const CellDistance& cell : surfaceDistances(phi, origin, h, notAsked)) {
    held[cell.offset] = true;
    if (std::abs(block[FluxBlock::index(cell.offset)] / h - cell.phi) > kRightEnough)
      plan.moved.push_back(cell);
  }
  for (const NearCell& cell : plan.near)
    if (!held[cell.offset] && !notAsked[cell.offset])
      held[cell.offset] = keepCorner(cell, block + FluxBlock::index(cell.offset), h, plan.moved);
  std::erase_if(plan.near, [&](const NearCell& cell) { return held[cell.offset]; });
  for (std::int16_t i = 0; i < kLeafSize; ++i) {
    if (held[i]) plan.held.push_back(i);
  }
  if (visibility == nullptr) return plan;
  std::array<bool, kLeafSize> isNear{};
  for (const NearCell& cell : plan.near) isNear[cell.offset] = true;
  for (int i = 0; i < kLeafSize; ++i) {
    if (!held[i] && !isNear[i] && !(*visibility)[i].seesAll())
      plan.oneSided.push_back({i, {1.0f, 1.0f, 1.0f, 1.0f, 1.0f, 1.0f}, &(*visibility)[i]});
  }
  return plan;
}

// One step: to = from + dtau L(from).
void eulerStep(const FloatTree& from, FloatLeaf& to, const LeafPlan& plan, float h, float background) {
  if (plan.rests()) return;
  static thread_local float block[kBlock];  // 0 where nothing is gathered
  gather(from, to.origin(), FluxBlock::kHalo, block, true);
  const float inverse = 1.0f / h;
  for (float& value : block) value *= inverse;
  float square[kLeafSize] = {};
  for (int axis = 0; axis < 3; ++axis) addSlopes(block, FluxBlock::kStride[axis], square);
  float step[kLeafSize];
  std::fill_n(step, kLeafSize, kCourant);
  const auto slope = [&](const NearCell& cell) {
    const float* p = block + FluxBlock::index(cell.offset);
    return cell.visible != nullptr ? slopeAt(OneSidedValues(p, *cell.visible), cell)
                                   : slopeAt(StoredValues{p}, cell);
  };
  for (const NearCell& cell : plan.oneSided) square[cell.offset] = slope(cell);
  for (const NearCell& cell : plan.near) {
    square[cell.offset] = slope(cell);
    step[cell.offset] = kCourant * *std::min_element(cell.reach.begin(), cell.reach.end());
  }
  float* out = to.buffer().data();
  float kept[kLeafSize];
  for (std::size_t n = 0; n < plan.held.size(); ++n) kept[n] = out[plan.held[n]];
  for (int i = 0; i < kLeafDim; ++i) {
    for (int j = 0; j < kLeafDim; ++j) {
      const float* p = block +
                       ((i + FluxBlock::kHalo) * FluxBlock::kSide + j + FluxBlock::kHalo) * FluxBlock::kSide +
                       FluxBlock::kHalo;
      const int row = 64 * i + 8 * j;
      for (int k = 0; k < kLeafDim; ++k) {
        const float now = p[k];
        const float change = step[row + k] * (1.0f - std::sqrt(square[row + k]));
        float next = h * (now + (now < 0.0f ? -change : change));
        next = least(background, most(-background, next));
        // The sign never changes: that would create a surface from nothing.
        out[row + k] = (next < 0.0f) != (now < 0.0f) ? h * now : next;
      }
    }
  }
  for (std::size_t n = 0; n < plan.held.size(); ++n) out[plan.held[n]] = kept[n];
}

}  // namespace

void redistance(FloatGrid& phi, const FloatGrid& solidPhi, int iterations, const Visibility* visibility) {
  const float h = static_cast<float>(phi.voxelSize()[0]);
  const auto leaves = leavesOf(phi.tree());
  std::vector<LeafPlan> plans(leaves.size());
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    const Coord& origin = leaves[n]->origin();
    plans[n] = planLeaf(phi.constTree(), solidPhi.constTree(), origin, h,
                        visibility != nullptr ? visibility->leaf(origin) : nullptr);
  });
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    for (const CellDistance& cell : plans[n].moved) leaves[n]->setValueOnly(cell.offset, h * cell.phi);
  });
  FloatTree other(phi.constTree());
  const auto otherLeaves = leavesOf(other);
  for (int iteration = 0; iteration < iterations; ++iteration) {
    const bool back = iteration % 2 == 1;
    const FloatTree& from = back ? other : phi.constTree();
    const auto& to = back ? leaves : otherLeaves;
    tbb::parallel_for(std::size_t{0}, to.size(),
                      [&](std::size_t n) { eulerStep(from, *to[n], plans[n], h, phi.background()); });
  }
  if (iterations % 2 == 0) return;
  tbb::parallel_for(std::size_t{0}, leaves.size(),
                    [&](std::size_t n) { leaves[n]->swap(otherLeaves[n]->buffer()); });
}

void redistance(FloatGrid& phi, const SolidField& solid, int iterations) {
  redistance(phi, *solid.phiMirrored, iterations, solid.visibility.get());
  mirrorAtSides(phi, solid);
}

}  // namespace fluidtex::sim
