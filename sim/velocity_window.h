// A leaf's neighbourhood copied side by side, for kernels that sample fields at many places around a leaf.
#pragma once

#include "sim/mac_grid.h"
#include "sim/trilinear.h"

#include <algorithm>
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
    return trilinear(p, side * side, side, t[0], t[1], t[2]);
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

inline Vec3f faceShift(int axis) {
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
  const Window& component(int axis) const { return axis == 0 ? u : (axis == 1 ? v : w); }

  // All three components; as Window::at.
  Vec3f at(const Vec3f& x) const {
    const Lanes velocity = sample(lanes(x[0], x[1], x[2]));
    return Vec3f(lane0(velocity), lane1(velocity), lane2(velocity));
  }

  // Where x gets to along the velocity; step: dt / h, negative to trace back.
  Vec3f trace(const Vec3f& x, float step) const {
    const Lanes from = lanes(x[0], x[1], x[2]);
    const Lanes k1 = sample(from);
    const Lanes k2 = sample(from + lanes(0.5f * step) * k1);
    const Lanes k3 = sample(from + lanes(0.75f * step) * k2);
    const Lanes to =
        from + lanes(step * (1.0f / 9.0f)) * (lanes(2.0f) * k1 + lanes(3.0f) * k2 + lanes(4.0f) * k3);
    return Vec3f(lane0(to), lane1(to), lane2(to));
  }

 private:
  Lanes sample(Lanes x) const {
    const auto halo = static_cast<float>(u.halo);
    const Lanes inside = _mm_min_ps(_mm_max_ps(x + lanes(halo - 0.5f), lanes(0.0f)),
                                    lanes(static_cast<float>(u.side) - 1.501f));
    const StaggeredBlocks blocks{{u.values.get(), v.values.get(), w.values.get()}, u.side};
    return blocks.at(inside);
  }
};

}  // namespace fluidtex::sim
