// Based on: Stam, "Stable fluids", 1999 (semi-Lagrangian); Selle, Fedkiw, Kim, Liu and Rossignac, "An
// unconditionally stable MacCormack method", 2008 (correction and limiter); Ralston, "Runge-Kutta methods
// with minimum error bounds", 1962 (third-order trace).
#include "sim/advect_velocity.h"

#include "sim/leaf_table.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <tuple>
#include <utility>

namespace fluidtex::sim {
namespace {

using Vec3f = openvdb::Vec3f;

// A field's values around one leaf, sampled trilinearly at positions in units of h from the leaf's lower
// corner.
struct Window {
  int halo = 0;
  int side = 0;
  std::unique_ptr<float[]> values;
  Vec3f shift{0.0f};  // of the samples within the cell

  Window(int width, const Vec3f& sampleShift)
      : halo(width),
        side(kLeafDim + 2 * width),
        values(std::make_unique<float[]>(side * side * side)),
        shift(sampleShift) {}

  void load(const FloatTree& tree, const Coord& origin) { gather(tree, origin, halo, values.get()); }

  // Index of the lower corner of the box of samples around x, and the place in it. Positions beyond the
  // window are taken at its edge.
  const float* locate(const Vec3f& x, float* t) const {
    int index[3];
    for (int a = 0; a < 3; ++a) {
      const float p =
          std::clamp(x[a] - shift[a] + static_cast<float>(halo), 0.0f, static_cast<float>(side) - 1.001f);
      index[a] = static_cast<int>(p);
      t[a] = p - static_cast<float>(index[a]);
    }
    return values.get() + (index[0] * side + index[1]) * side + index[2];
  }

  float at(const Vec3f& x) const {
    float t[3];
    const float* p = locate(x, t);
    const int dx = side * side, dy = side;
    const auto mix = [](float a, float b, float w) { return a + w * (b - a); };
    const float x0 = mix(mix(p[0], p[1], t[2]), mix(p[dy], p[dy + 1], t[2]), t[1]);
    const float x1 = mix(mix(p[dx], p[dx + 1], t[2]), mix(p[dx + dy], p[dx + dy + 1], t[2]), t[1]);
    return mix(x0, x1, t[0]);
  }

  // Smallest and largest of the eight samples around x.
  std::pair<float, float> range(const Vec3f& x) const {
    float t[3];
    const float* p = locate(x, t);
    const int dx = side * side, dy = side;
    const auto [low, high] =
        std::minmax({p[0], p[1], p[dy], p[dy + 1], p[dx], p[dx + 1], p[dx + dy], p[dx + dy + 1]});
    return {low, high};
  }
};

Vec3f faceShift(int axis) {
  Vec3f shift(0.5f);
  shift[axis] = 0.0f;
  return shift;
}

struct VelocityWindow {
  Window u, v, w;
  explicit VelocityWindow(int halo) : u(halo, faceShift(0)), v(halo, faceShift(1)), w(halo, faceShift(2)) {}

  void load(const Velocity& velocity, const Coord& origin) {
    u.load(velocity.component[0]->constTree(), origin);
    v.load(velocity.component[1]->constTree(), origin);
    w.load(velocity.component[2]->constTree(), origin);
  }
  Vec3f at(const Vec3f& x) const { return Vec3f(u.at(x), v.at(x), w.at(x)); }
  const Window& component(int axis) const { return axis == 0 ? u : (axis == 1 ? v : w); }

  // Where x gets to along the velocity; step: dt / h, negative to trace back.
  Vec3f trace(const Vec3f& x, float step) const {
    const Vec3f k1 = at(x);
    const Vec3f k2 = at(x + 0.5f * step * k1);
    const Vec3f k3 = at(x + 0.75f * step * k2);
    return x + step * (2.0f * k1 + 3.0f * k2 + 4.0f * k3) * (1.0f / 9.0f);
  }
};

// Bits: this face touches liquid; the correction may be applied.
enum : std::uint8_t { kWanted = 1, kCorrect = 2 };

// What the first pass keeps of a leaf for the second, for each component and voxel.
struct LeafPass {
  std::uint8_t flags[3][kLeafSize] = {};
  float low[3][kLeafSize], high[3][kLeafSize];
};

// Samples this deep in the liquid (in cells) have only liquid's velocities around them.
constexpr float kWellInside = -1.5f;

Vec3f facePosition(int offset, int axis) {
  return Vec3f(static_cast<float>(offset >> 6), static_cast<float>((offset >> 3) & 7),
               static_cast<float>(offset & 7)) +
         faceShift(axis);
}

}  // namespace

void advectVelocity(const Velocity& from, Velocity& to, const FloatGrid& phiFrom, const FloatGrid& phiTo,
                    double dt) {
  const float h = static_cast<float>(phiFrom.voxelSize()[0]);
  const float step = static_cast<float>(dt) / h;
  const double reach = dt * maxAbs(from) / h;
  const int halo = std::min(kLeafDim, static_cast<int>(std::ceil(reach)) + 2);

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
        VelocityWindow window(halo);
        Window before(halo, centre), after(1, centre);
        for (std::size_t n = range.begin(); n != range.end(); ++n) {
          const Coord origin = target[0][n]->origin();
          after.load(phiTo.constTree(), origin);
          const float* begin = after.values.get();
          if (std::all_of(begin, begin + after.side * after.side * after.side,
                          [](float p) { return p >= 0.0f; }))
            continue;
          passes[n] = std::make_unique<LeafPass>();
          LeafPass& pass = *passes[n];
          window.load(from, origin);
          before.load(phiFrom.constTree(), origin);
          for (int axis = 0; axis < 3; ++axis) {
            const Window& own = window.component(axis);
            const int below = axis == 0 ? after.side * after.side : (axis == 1 ? after.side : 1);
            float* out = guess[axis][n]->buffer().data();
            for (int i = 0; i < kLeafSize; ++i) {
              const float* p =
                  begin + (((i >> 6) + 1) * after.side + ((i >> 3) & 7) + 1) * after.side + (i & 7) + 1;
              if (!target[axis][n]->isValueOn(i) || (p[0] >= 0.0f && p[-below] >= 0.0f)) continue;
              const Vec3f x = facePosition(i, axis);
              const Vec3f origin3 = window.trace(x, -step);
              out[i] = own.at(origin3);
              pass.flags[axis][i] = kWanted;
              if (std::max(p[0], p[-below]) < inside && before.at(origin3) < inside) {
                pass.flags[axis][i] |= kCorrect;
                std::tie(pass.low[axis][i], pass.high[axis][i]) = own.range(origin3);
              }
            }
          }
        }
      });

  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, leafCount),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      VelocityWindow window(halo), ahead(halo);
                      Window after(halo, centre);
                      for (std::size_t n = range.begin(); n != range.end(); ++n) {
                        if (!passes[n]) continue;
                        const LeafPass& pass = *passes[n];
                        const Coord origin = target[0][n]->origin();
                        window.load(from, origin);
                        ahead.load(predicted, origin);
                        after.load(phiTo.constTree(), origin);
                        for (int axis = 0; axis < 3; ++axis) {
                          const float* first = guess[axis][n]->buffer().data();
                          float* out = target[axis][n]->buffer().data();
                          for (int i = 0; i < kLeafSize; ++i) {
                            if ((pass.flags[axis][i] & kWanted) == 0) continue;
                            out[i] = first[i];
                            if ((pass.flags[axis][i] & kCorrect) == 0) continue;
                            const Vec3f x = facePosition(i, axis);
                            const Vec3f goal = window.trace(x, step);
                            if (after.at(goal) >= inside) continue;
                            const float back = ahead.component(axis).at(goal);
                            const float corrected = first[i] + 0.5f * (window.component(axis).at(x) - back);
                            out[i] = std::clamp(corrected, pass.low[axis][i], pass.high[axis][i]);
                          }
                        }
                      }
                    });
}

}  // namespace fluidtex::sim
