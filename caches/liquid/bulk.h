// The bulk of a liquid: away from its sheets, jets and drops, and from gaps that close, which burst and merge
// between two frames.
#pragma once

#include <openvdb/openvdb.h>

#include <vector>

namespace fluidtex::caches {

// Liquid, and air between liquid, that is thinner counts as thin, cells.
inline constexpr int kThin = 8;
// The bulk begins so far from what is thin, cells along each axis.
inline constexpr int kClear = 12;

// Whether each of the places (metres) lies kClear cells or more from all that is thin. Requires: phi a level
// set in metres that is known to kThin / 2 + 1 cells to either side.
std::vector<bool> isInBulk(const openvdb::FloatGrid& phi, const std::vector<openvdb::Vec3d>& places);

}  // namespace fluidtex::caches
