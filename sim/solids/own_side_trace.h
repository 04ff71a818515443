// Traces of places beside thin walls, with velocities of their own side of the wall only.
#pragma once

#include "sim/solids/visibility.h"

#include <algorithm>
#include <cmath>

namespace fluidtex::sim {

using openvdb::Vec3f;

// Traces from one leaf. Places are in cells from the leaf's lower corner, velocities in cells a step.
// Speed: float speed(int axis, const Vec3f& place), a component by interpolation between faces.
template <class Speed>
class OwnSideTrace {
 public:
  // All must outlive this.
  OwnSideTrace(const Visibility& visibility, const Coord& origin, const Speed& speed)
      : m_visibility(visibility), m_origin(origin), m_speed(speed) {}

  // The end of a trace that was made without regard to walls and leads to `to`; traced anew where it begins
  // or ends within VisibleCells::kReach cells of a thin wall. One that only passes such a wall stays as it
  // is.
  Vec3f corrected(const Vec3f& start, const Coord& cell, const Vec3f& to) const {
    return around(cell) != nullptr || around(cellAt(to)) != nullptr ? (*this)(start, cell) : to;
  }

  // The place to which `start`, in or on a face of `cell`, moves. Third-order Runge-Kutta [Ralston 1962].
  Vec3f operator()(const Vec3f& start, const Coord& cell) const {
    const Vec3f k1 = velocityAt(start, cell);
    const Vec3f k2 = velocityAt(start + 0.5f * k1, cell);
    const Vec3f k3 = velocityAt(start + 0.75f * k2, cell);
    return start + (2.0f * k1 + 3.0f * k2 + 4.0f * k3) / 9.0f;
  }

  static Coord cellAt(const Vec3f& place) {
    return Coord(static_cast<int>(std::floor(place[0])), static_cast<int>(std::floor(place[1])),
                 static_cast<int>(std::floor(place[2])));
  }

 private:
  const VisibleCells* around(const Coord& cell) const { return m_visibility.around(m_origin + cell); }

  // A place that a wall hides from `from` is read at the wall instead: in that cell.
  Vec3f velocityAt(Vec3f place, const Coord& from) const {
    Coord cell = cellAt(place);
    if (m_visibility.hides(m_origin + from, m_origin + cell)) {
      cell = from;
      for (int a = 0; a < 3; ++a) {
        const auto low = static_cast<float>(cell[a]);
        place[a] = std::clamp(place[a], low, low + 1.0f);
      }
    }
    const VisibleCells* visible = around(cell);
    const Vec3f middle = cell.asVec3s() + Vec3f(0.5f);
    Vec3f velocity;
    for (int a = 0; a < 3; ++a)
      velocity[a] =
          m_speed(a, visible == nullptr ? place : middle + moveToOwnSide(*visible, place - middle, a));
    return velocity;
  }

  const Visibility& m_visibility;
  Coord m_origin;
  const Speed& m_speed;
};

}  // namespace fluidtex::sim
