// Depths in solids to which cells hold values.
#pragma once

namespace fluidtex::sim {

// Cells deeper in a solid than this many voxels hold values that are extrapolated from the liquid beside the
// solid. No face of such a cell is open, except for slivers.
inline constexpr float kDeepInSolid = 0.49f;

// Depth behind a solid's surface, in voxels, to which cells hold values of phi and velocity. The solid's
// distance is known that far.
inline constexpr float kSolidLayers = 2.99f;

}  // namespace fluidtex::sim
