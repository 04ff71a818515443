// How deep in solids cells hold values.
#pragma once

namespace fluidtex::sim {

// Cells deeper in a solid than this many voxels hold what goes on from the liquid beside the solid; no face
// of such a cell is open, but for a sliver.
inline constexpr float kDeepInSolid = 0.49f;

// Layers of cells behind a solid's surface that hold values of phi and velocity, in voxels of depth. The
// solid's distance is known that far.
inline constexpr float kSolidLayers = 2.99f;

}  // namespace fluidtex::sim
