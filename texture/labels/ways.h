// Ways to lay an exemplar that looks the same turned, by halves or quarters of a turn, or mirrored.
#pragma once

#include "texture/labels/labels.h"
#include "texture/options.h"

#include <cassert>
#include <cstdint>

namespace fluidtex::texture {

// What takes an offset on the surface to one in the exemplar: it is mirrored (first component negated) if
// kMirrored is set, then turned by so many quarter turns, 0 to 3.
using Way = std::uint8_t;
inline constexpr Way kMirrored = 4;
inline constexpr int kMostWays = 8;

// An offset l on the surface, as one in the exemplar.
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

// The i-th of them; the first is upright.
inline Way wayAt(const Ways& ways, int i) {
  assert(i >= 0 && i < countOf(ways));
  const Way turned = Way(i % ways.turns * (4 / ways.turns));
  return i < ways.turns ? turned : turned | kMirrored;
}

// The one nearest to how something lies; mirrored as that is, where that may be.
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
