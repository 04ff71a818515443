// Based on: Strain, "Semi-Lagrangian methods for level set equations", 1999; Ralston, "Runge-Kutta methods
// with minimum error bounds", 1962 (third-order trace).
#include "sim/surface/advect_phi.h"

#include "sim/grid/dilate.h"
#include "sim/grid/leaf_table.h"
#include "sim/grid/local_reach.h"
#include "sim/grid/velocity_window.h"
#include "sim/solids/own_side_trace.h"
#include "sim/solids/solid_layers.h"
#include "sim/solids/trace_end.h"
#include "sim/surface/extend_into_solids.h"
#include "sim/surface/level_set.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>

namespace fluidtex::sim {
namespace {

// Liquid along a wall that moves by more than this in a step, in cells, leaves the wall; liquid at rest does
// not.
constexpr float kMoves = 0.02f;
// Farther from the surface than this, in cells, phi is interpolated linearly: accuracy does not matter there.
constexpr float kFar = 4.0f;

using LeafBuffer = std::array<float, kLeafSize>;

bool isFlat(const Window& window) {
  const float* first = window.values.get();
  const float* last = first + window.side * window.side * window.side;
  return std::all_of(first, last, [value = *first](float v) { return v == value; });
}

// Whether the surface lies on a thin wall, in a cell and beside it along the wall. solid: the wall's
// distance.
bool liesOnSolid(const Stencil& phi, const VisibleCells& visible, float solid, float h) {
  constexpr float kSame = 0.05f;  // of a cell
  constexpr int kMiddle = VisibleCells::kMiddle;
  if (phi[kMiddle] >= 0.0f || std::abs(phi[kMiddle] + solid) > kSame * h) return false;
  for (const int stride : VisibleCells::kStride) {
    if (!visible.sees(kMiddle - stride) || !visible.sees(kMiddle + stride)) continue;  // not along the wall
    if (std::min(phi[kMiddle - stride], phi[kMiddle + stride]) < -solid - kSame * h) return false;
  }
  return true;
}

// phi at a place as seen from a cell to which not all cells around it are visible. solid: the solids'
// distance in that cell. leaves: the liquid moves, so that it may leave a wall.
float oneSided(const Window& window, const Coord& cell, const Vec3f& x, const VisibleCells& visible,
               float solid, float h, bool leaves) {
  Stencil values;
  const Vec3f local = window.around(cell, x, values);
  if (leaves && liesOnSolid(values, visible, solid, h))
    riseBehind(values, visible, h);
  else
    extrapolateBehind(values, visible, leaves ? kAlongWall * h : std::numeric_limits<float>::infinity());
  constexpr const int* kStride = VisibleCells::kStride;
  const float* low = values.data() + VisibleCells::kMiddle;
  float t[3];
  bool cubicFits = true;
  for (int a = 0; a < 3; ++a) {
    const float whole = std::floor(local[a]);
    low += static_cast<std::ptrdiff_t>(whole) * kStride[a];
    t[a] = local[a] - whole;
    cubicFits = cubicFits && (whole == 0.0f || whole == -1.0f);
  }
  const float linear = trilinear(low, kStride[0], kStride[1], t[0], t[1], t[2]);
  if (!cubicFits || std::abs(linear) > kFar * h) return linear;
  float least = *low, most = *low;
  for (int n = 1; n < 8; ++n) {
    const float v = low[(n >> 2) * kStride[0] + (n >> 1 & 1) * kStride[1] + (n & 1)];
    least = std::min(least, v);
    most = std::max(most, v);
  }
  const float cubic = tricubic(low, kStride[0], kStride[1], t[0], t[1], t[2]);
  return cubic > least && cubic < most ? cubic : linear;
}

// One sub-step, of at most kMaxTrace cells.
void moveOnce(FloatGrid& phi, const Velocity& velocity, const FloatGrid& solidPhi, double dt, int reach,
              const Visibility* visibility) {
  openvdb::tools::dilateActiveValues(phi.tree(), reach, openvdb::tools::NN_FACE,
                                     openvdb::tools::EXPAND_TILES);
  const float h = static_cast<float>(phi.voxelSize()[0]), step = static_cast<float>(-dt) / h;
  const float deepest = -kSolidLayers * h, far = kFar * h;
  const auto leaves = leavesOf(phi.tree());
  std::vector<std::unique_ptr<LeafBuffer>> moved(leaves.size());
  const LocalReach local(velocity, dt);
  using Range = tbb::blocked_range<std::size_t>;
  tbb::parallel_for(Range(0, leaves.size()), [&](const Range& range) {
    VelocityWindow window(reach + 1);
    Window before(reach + 2, Vec3f(0.5f));
    TraceEnd end(solidPhi, visibility);
    const auto solids = solidPhi.getConstAccessor();
    for (std::size_t n = range.begin(); n != range.end(); ++n) {
      const Coord origin = leaves[n]->origin();
      const int near = std::min(reach, static_cast<int>(std::ceil(local.from(origin))) + 1);
      window.setHalo(near + 1);
      before.setHalo(near + 2);
      before.load(phi.constTree(), origin);
      if (isFlat(before)) continue;
      window.load(velocity, origin);
      end.setLeaf(origin, near);
      moved[n] = std::make_unique<LeafBuffer>();
      std::copy_n(leaves[n]->buffer().data(), kLeafSize, moved[n]->data());
      const auto speed = [&](int axis, const Vec3f& x) { return step * window.component(axis).at(x); };
      const auto look = [&](int i, Vec3f traced) {
        float& out = (*moved[n])[i];
        const Vec3f centre(float(i >> 6) + 0.5f, float((i >> 3) & 7) + 0.5f, float(i & 7) + 0.5f);
        if (end.nearThinWalls()) {
          const OwnSideTrace trace(*visibility, origin, speed);
          traced = trace.corrected(centre, trace.cellAt(centre), traced);
        }
        const auto [from, cell] = end(i, centre, traced);
        if (const VisibleCells* visible = end.nearThinWalls() ? visibility->around(cell) : nullptr) {
          out = oneSided(before, cell - origin, from, *visible, solids.getValue(cell), h,
                         (from - centre).length() > kMoves);
          return;
        }
        out = before.at(from);
        if (std::abs(out) > far) return;
        // The cubic overshoots at edges and where phi is extrapolated behind walls.
        const auto [low, high] = before.range(from);
        const float cubic = before.cubic(from);
        if (cubic > low && cubic < high) out = cubic;
      };
      forPairs([&](int i) { return end.solidAt(i) > deepest; },
               [&](int i, int other) {
                 const auto [from, fromOther] = window.traceCentres(i, other, step);
                 look(i, from);
                 look(other, fromOther);
               });
    }
  });
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    if (moved[n]) std::copy_n(moved[n]->data(), kLeafSize, leaves[n]->buffer().data());
  });
}

}  // namespace

void advectPhi(FloatGrid& phi, const Velocity& velocity, const FloatGrid& solidPhi, double dt,
               const Visibility* visibility) {
  const double way = dt * maxAbs(velocity) / phi.voxelSize()[0];
  if (way == 0.0) return;
  const int substeps = static_cast<int>(std::ceil(way / kMaxTrace));
  const int reach = static_cast<int>(std::ceil(way / substeps)) + 1;
  for (int n = 0; n < substeps; ++n) moveOnce(phi, velocity, solidPhi, dt / substeps, reach, visibility);
}

}  // namespace fluidtex::sim
