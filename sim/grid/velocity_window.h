// A leaf's neighbourhood copied into one array, for kernels that sample fields at many places around a leaf.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/grid/tricubic.h"
#include "sim/grid/visible_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

namespace fluidtex::sim {

using Vec3f = openvdb::Vec3f;

// A field's values around one leaf, sampled trilinearly at positions in units of h from the leaf's lower
// corner.
struct Window {
  int halo = 0;
  int side = 0;
  std::unique_ptr<float[]> values;
  Vec3f shift{0.0f};  // of the samples within the cell

  Window(int widest, const Vec3f& sampleShift)
      : halo(widest),
        side(kLeafDim + 2 * widest),
        values(std::make_unique_for_overwrite<float[]>(side * side * side)),
        shift(sampleShift) {}

  // Call before load(); at most the halo given to the constructor.
  void setHalo(int width) {
    halo = width;
    side = kLeafDim + 2 * width;
  }

  void load(const FloatTree& tree, const Coord& origin) { gather(tree, origin, halo, values.get()); }

  float at(const Vec3f& x) const {
    const Place place = locate(x);
    const Float4& t = place.t;
    return trilinear(place.low, side * side, side, t[0], t[1], t[2]);
  }

  // The same by cubic interpolation; halo >= 1.
  float cubic(const Vec3f& x) const {
    const Place place = locate(x, 1);
    const Float4& t = place.t;
    return tricubic(place.low, side * side, side, t[0], t[1], t[2]);
  }

  // The samples of a cell and those around it, and x from that cell's centre, in cells; for samples at cell
  // centres. x is clamped to a cell outside the cell. cell: from the leaf's lowest one, at most halo - 2
  // outside the leaf.
  Vec3f around(Coord cell, const Vec3f& x, Stencil& out) const {
    constexpr int kReach = VisibleCells::kReach;
    constexpr float kFarthest = static_cast<float>(kReach) - 0.5f;
    Vec3f local;
    for (int a = 0; a < 3; ++a) {
      cell[a] = std::clamp(cell[a], kReach - halo, kLeafDim + halo - kReach - 1);
      local[a] = std::clamp(x[a] - static_cast<float>(cell[a]) - 0.5f, -kFarthest, kFarthest);
    }
    const float* from = values.get() + ((cell[0] + halo - kReach) * side + cell[1] + halo - kReach) * side +
                        cell[2] + halo - kReach;
    float* to = out.data();
    for (int i = 0; i < VisibleCells::kSide; ++i)
      for (int j = 0; j < VisibleCells::kSide; ++j, to += VisibleCells::kSide)
        std::copy_n(from + (i * side + j) * side, VisibleCells::kSide, to);
    return local;
  }

  // Smallest and largest of the eight samples around x.
  std::pair<float, float> range(const Vec3f& x) const {
    const float* p = locate(x).low;
    const Float4 near = facePoints(p, side), far = facePoints(p + side * side, side);
    Float4 low = _mm_min_ps(near, far), high = _mm_max_ps(near, far);
    low = _mm_min_ps(low, _mm_movehl_ps(low, low));
    high = _mm_max_ps(high, _mm_movehl_ps(high, high));
    return {std::min(low[0], low[1]), std::max(high[0], high[1])};
  }

 private:
  // The lowest of the eight samples around x, and where x is between them. Positions nearer to the window's
  // edge than `around` samples, or beyond it, are clamped to that.
  struct Place {
    const float* low;
    Float4 t;
  };
  Place locate(const Vec3f& x, int around = 0) const {
    const Float4 from =
        float4(x[0], x[1], x[2]) + (static_cast<float>(halo) - float4(shift[0], shift[1], shift[2]));
    const auto least = static_cast<float>(around), most = static_cast<float>(side - around) - 1.001f;
    const Float4 p = _mm_min_ps(_mm_max_ps(from, float4(least)), float4(most));
    const __m128i cell = _mm_cvttps_epi32(p);
    const std::ptrdiff_t i = _mm_cvtsi128_si32(cell), j = _mm_extract_epi32(cell, 1),
                         k = _mm_extract_epi32(cell, 2);
    return {values.get() + (i * side + j) * side + k, p - _mm_cvtepi32_ps(cell)};
  }
};

// Calls body(i, j) for the voxels of a leaf for which wanted() holds, two at a time; with an odd number the
// last is repeated.
template <class Wanted, class Body>
void forPairs(const Wanted& wanted, const Body& body) {
  int waiting = -1;
  for (int i = 0; i < kLeafSize; ++i) {
    if (!wanted(i)) continue;
    if (waiting < 0) {
      waiting = i;
    } else {
      body(waiting, i);
      waiting = -1;
    }
  }
  if (waiting >= 0) body(waiting, waiting);
}

inline Vec3f faceShift(int axis) {
  Vec3f shift(0.5f);
  shift[axis] = 0.0f;
  return shift;
}

struct VelocityWindow {
  Window u, v, w;
  explicit VelocityWindow(int widest)
      : u(widest, faceShift(0)), v(widest, faceShift(1)), w(widest, faceShift(2)) {}

  void setHalo(int width) {
    u.setHalo(width);
    v.setHalo(width);
    w.setHalo(width);
  }

  void load(const Velocity& velocity, const Coord& origin) {
    u.load(velocity.component[0]->constTree(), origin);
    v.load(velocity.component[1]->constTree(), origin);
    w.load(velocity.component[2]->constTree(), origin);
  }
  const Window& component(int axis) const { return axis == 0 ? u : (axis == 1 ? v : w); }

  // All three components; as Window::at.
  Vec3f at(const Vec3f& x) const {
    const Float4 velocity = velocityAt(x);
    return Vec3f(velocity[0], velocity[1], velocity[2]);
  }

  // The place to which the velocity moves x; step: dt / h, negative to trace back.
  Vec3f trace(const Vec3f& x, float step) const {
    const Start start{float4(x[0], x[1], x[2]), velocityAt(x)};
    return traceOn(start, start, step)[0];
  }

  // The same from the centres of two of the leaf's voxels: the first velocity is a mean of samples.
  std::array<Vec3f, 2> traceCentres(int offset, int other, float step) const {
    return traceOn(startAtCentre(offset), startAtCentre(other), step);
  }

  // The same from the lower faces, normal to `axis`, of two of the leaf's voxels.
  std::array<Vec3f, 2> traceFaces(int offset, int other, int axis, float step) const {
    return traceOn(startAtFace(offset, axis), startAtFace(other, axis), step);
  }

 private:
  // A place and the velocity there.
  struct Start {
    Float4 place, velocity;
  };

  Float4 velocityAt(const Vec3f& x) const {
    const Float4 place = float4(x[0], x[1], x[2]);
    return low4(sample(joined8(place, place)));
  }

  Start startAtCentre(int offset) const {
    const std::ptrdiff_t side = u.side;
    const std::ptrdiff_t i = offset >> 6, j = (offset >> 3) & 7, k = offset & 7;
    const std::ptrdiff_t at = ((i + u.halo) * side + j + u.halo) * side + k + u.halo;
    const float *a = u.values.get() + at, *b = v.values.get() + at, *c = w.values.get() + at;
    const Float4 from = float4(static_cast<float>(i), static_cast<float>(j), static_cast<float>(k));
    return {from + 0.5f, 0.5f * float4(a[0] + a[side * side], b[0] + b[side], c[0] + c[1])};
  }

  Start startAtFace(int offset, int axis) const {
    const std::ptrdiff_t side = u.side;
    const std::ptrdiff_t stride[3] = {side * side, side, 1};
    const int local[3] = {offset >> 6, (offset >> 3) & 7, offset & 7};
    std::ptrdiff_t at = 0;
    float from[3], first[3];
    for (int a = 0; a < 3; ++a) {
      at += (local[a] + u.halo) * stride[a];
      from[a] = static_cast<float>(local[a]) + (a == axis ? 0.0f : 0.5f);
    }
    for (int a = 0; a < 3; ++a) {
      const float* p = component(a).values.get() + at;
      const float* below = p - stride[axis];
      first[a] = a == axis ? p[0] : 0.25f * (p[0] + p[stride[a]] + below[0] + below[stride[a]]);
    }
    return {float4(from[0], from[1], from[2]), float4(first[0], first[1], first[2])};
  }

  std::array<Vec3f, 2> traceOn(const Start& first, const Start& second, float step) const {
    const Float8 from = joined8(first.place, second.place), k1 = joined8(first.velocity, second.velocity);
    const Float8 k2 = sample(from + 0.5f * step * k1);
    const Float8 k3 = sample(from + 0.75f * step * k2);
    const Float8 to = from + step * (1.0f / 9.0f) * (2.0f * k1 + 3.0f * k2 + 4.0f * k3);
    const Float4 a = low4(to), b = high4(to);
    return {Vec3f(a[0], a[1], a[2]), Vec3f(b[0], b[1], b[2])};
  }

  Float8 sample(Float8 x) const {
    const auto halo = static_cast<float>(u.halo);
    const Float8 inside = _mm256_min_ps(_mm256_max_ps(x + (halo - 0.5f), float8(0.0f)),
                                        float8(static_cast<float>(u.side) - 1.501f));
    const StaggeredBlocks blocks{{u.values.get(), v.values.get(), w.values.get()}, u.side};
    return blocks.at(inside);
  }
};

}  // namespace fluidtex::sim
