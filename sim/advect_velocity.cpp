// Based on: Stam, "Stable fluids", 1999 (semi-Lagrangian); Selle, Fedkiw, Kim, Liu and Rossignac, "An
// unconditionally stable MacCormack method", 2008 (correction and limiter); Ralston, "Runge-Kutta methods
// with minimum error bounds", 1962 (third-order trace).
#include "sim/advect_velocity.h"

#include "sim/leaf_table.h"
#include "sim/local_reach.h"
#include "sim/velocity_window.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace fluidtex::sim {
namespace {

// Bits: this face touches liquid; the correction may be applied.
enum : std::uint8_t { kWanted = 1, kCorrect = 2 };

// What the first pass keeps of a leaf for the second, for each component and voxel.
struct LeafPass {
  std::uint8_t flags[3][kLeafSize] = {};
  std::vector<std::pair<float, float>> bounds;  // of the values to be corrected, in order
};

// Samples this deep in the liquid (in cells) have only liquid's velocities around them.
constexpr float kWellInside = -1.5f;

}  // namespace

void advectVelocity(const Velocity& from, const Velocity& carried, Velocity& to, const FloatGrid& phiFrom,
                    const FloatGrid& phiTo, double dt) {
  const float h = static_cast<float>(phiFrom.voxelSize()[0]);
  const float step = static_cast<float>(dt) / h;
  const LocalReach reach(from, dt);
  const auto haloOf = [&](const Coord& origin) {
    return std::min(kLeafDim, static_cast<int>(std::ceil(reach.from(origin))) + 2);
  };

  std::array<std::vector<FloatLeaf*>, 3> target;
  for (int a = 0; a < 3; ++a) target[a] = leavesOf(to.component[a]->tree());
  Velocity predicted = makeVelocity(h, to.component[0]->constTree());
  std::array<std::vector<FloatLeaf*>, 3> guess;
  for (int a = 0; a < 3; ++a) guess[a] = leavesOf(predicted.component[a]->tree());
  const std::size_t leafCount = target[0].size();
  std::vector<std::unique_ptr<LeafPass>> passes(leafCount);

  const Vec3f centre(0.5f);
  const float inside = kWellInside * h;
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, leafCount), [&](const tbb::blocked_range<std::size_t>& range) {
        VelocityWindow window(kLeafDim), content(kLeafDim);
        Window before(kLeafDim, centre), after(1, centre);
        for (std::size_t n = range.begin(); n != range.end(); ++n) {
          const Coord origin = target[0][n]->origin();
          after.load(phiTo.constTree(), origin);
          const float* begin = after.values.get();
          if (std::all_of(begin, begin + after.side * after.side * after.side,
                          [](float p) { return p >= 0.0f; }))
            continue;
          passes[n] = std::make_unique<LeafPass>();
          LeafPass& pass = *passes[n];
          const int halo = haloOf(origin);
          window.setHalo(halo);
          content.setHalo(halo);
          before.setHalo(halo);
          window.load(from, origin);
          content.load(carried, origin);
          before.load(phiFrom.constTree(), origin);
          for (int axis = 0; axis < 3; ++axis) {
            const Window& own = content.component(axis);
            const int below = axis == 0 ? after.side * after.side : (axis == 1 ? after.side : 1);
            float* out = guess[axis][n]->buffer().data();
            // phi in the cell above a face and, `below` before it, in the one under it.
            const auto cellAbove = [&](int i) {
              return begin + (((i >> 6) + 1) * after.side + ((i >> 3) & 7) + 1) * after.side + (i & 7) + 1;
            };
            const auto look = [&](int i, const Vec3f& from3) {
              const float* p = cellAbove(i);
              out[i] = own.at(from3);
              pass.flags[axis][i] = kWanted;
              if (std::max(p[0], p[-below]) >= inside || before.at(from3) >= inside) return;
              pass.flags[axis][i] |= kCorrect;
              pass.bounds.push_back(own.range(from3));
            };
            forPairs(
                [&](int i) {
                  const float* p = cellAbove(i);
                  return target[axis][n]->isValueOn(i) && (p[0] < 0.0f || p[-below] < 0.0f);
                },
                [&](int i, int other) {
                  const auto origins = window.traceFaces(i, other, axis, -step);
                  look(i, origins[0]);
                  if (other != i) look(other, origins[1]);
                });
          }
        }
      });

  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, leafCount), [&](const tbb::blocked_range<std::size_t>& range) {
        VelocityWindow window(kLeafDim), content(0), ahead(kLeafDim);
        Window after(kLeafDim, centre);
        for (std::size_t n = range.begin(); n != range.end(); ++n) {
          if (!passes[n]) continue;
          const LeafPass& pass = *passes[n];
          auto bounds = pass.bounds.begin();
          const Coord origin = target[0][n]->origin();
          const int halo = haloOf(origin);
          window.setHalo(halo);
          ahead.setHalo(halo);
          after.setHalo(halo);
          window.load(from, origin);
          content.load(carried, origin);
          ahead.load(predicted, origin);
          after.load(phiTo.constTree(), origin);
          for (int axis = 0; axis < 3; ++axis) {
            const float* first = guess[axis][n]->buffer().data();
            float* out = target[axis][n]->buffer().data();
            for (int i = 0; i < kLeafSize; ++i) {
              if ((pass.flags[axis][i] & kWanted) != 0) out[i] = first[i];
            }
            const auto correct = [&](int i, const Vec3f& goal) {
              const auto [low, high] = *bounds++;
              if (after.at(goal) >= inside) return;
              const float back = ahead.component(axis).at(goal);
              const float corrected = first[i] + 0.5f * (content.component(axis).values[i] - back);
              out[i] = std::clamp(corrected, low, high);
            };
            forPairs([&](int i) { return (pass.flags[axis][i] & kCorrect) != 0; },
                     [&](int i, int other) {
                       const auto goals = window.traceFaces(i, other, axis, step);
                       correct(i, goals[0]);
                       if (other != i) correct(other, goals[1]);
                     });
          }
        }
      });
}

}  // namespace fluidtex::sim
