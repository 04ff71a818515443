// Ways to lay an exemplar that looks the same turned: by halves or quarters of a turn.
#pragma once

#include "texture/complex.h"
#include "texture/labels.h"

#include <array>
#include <cstdint>

namespace fluidtex::texture {

// How many quarter turns take an offset on the surface to one in the exemplar: 0 to 3.
using Way = std::uint8_t;

// An offset l on the surface, as one in the exemplar.
inline Vec2f laid(Way way, const Vec2f& l) {
  switch (way) {
    case 1:
      return {-l[1], l[0]};
    case 2:
      return {-l[0], -l[1]};
    case 3:
      return {l[1], -l[0]};
    default:
      return l;
  }
}

// The same, as a unit number.
inline Complexf turnOf(Way way) {
  const Vec2f x = laid(way, {1.0f, 0.0f});
  return {x[0], x[1]};
}

// Of the exemplar's `turns` ways (1, 2 or 4), the i-th.
inline Way wayAt(int turns, int i) {
  return Way(i * (4 / turns));
}

// The one nearest to a rotation, times any factor.
inline Way nearestWay(int turns, const Complexf& turn) {
  Way best = 0;
  float most = turn.real();
  for (int i = 1; i < turns; ++i) {
    const Way way = wayAt(turns, i);
    const float along = conjugateProduct(turnOf(way), turn).real();
    if (along > most) most = along, best = way;
  }
  return best;
}

// The rotation in a label's Jacobian, times a factor.
inline Complexf turnOf(const Label& label) {
  return {label.jacobian[0] + label.jacobian[3], label.jacobian[2] - label.jacobian[1]};
}

}  // namespace fluidtex::texture
