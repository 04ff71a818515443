// Symmetry variants of an exemplar: rotations by multiples of 90 degrees, and reflections.
#pragma once

#include "texture/labels/labels.h"
#include "texture/options.h"

#include <cassert>
#include <cstdint>

namespace fluidtex::texture {

// Takes an offset on the surface to one in the exemplar: mirrored (first component negated) if kMirrored is
// set, then rotated by 0 to 3 quarter turns.
using Way = std::uint8_t;
inline constexpr Way kMirrored = 4;
inline constexpr int kMostWays = 8;

// Offset in the exemplar for an offset l on the surface.
inline Vec2f laid(Way way, Vec2f l) {
  if (way & kMirrored) l[0] = -l[0];
  switch (way & 3) {
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

inline Lay layOf(Way way) {
  const Vec2f x = laid(way & 3, {1.0f, 0.0f});
  return {{x[0], x[1]}, (way & kMirrored) != 0};
}

inline int countOf(const Ways& ways) {
  return ways.mirrored ? 2 * ways.turns : ways.turns;
}

// The i-th variant; 0 is upright.
inline Way wayAt(const Ways& ways, int i) {
  assert(i >= 0 && i < countOf(ways));
  const Way turned = Way(i % ways.turns * (4 / ways.turns));
  return i < ways.turns ? turned : turned | kMirrored;
}

// The variant nearest to a placement; mirrored if the placement is, where that is allowed.
inline Way nearestWay(const Ways& ways, const Lay& lay) {
  const int begin = lay.mirrored && ways.mirrored ? ways.turns : 0;
  Way best = wayAt(ways, begin);
  float most = conjugateProduct(layOf(best).turn, lay.turn).real();
  for (int i = 1; i < ways.turns; ++i) {
    const Way way = wayAt(ways, begin + i);
    const float along = conjugateProduct(layOf(way).turn, lay.turn).real();
    if (along > most) most = along, best = way;
  }
  return best;
}

}  // namespace fluidtex::texture
