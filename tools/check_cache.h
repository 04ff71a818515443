// fluidtex check of another program's cache: what is in it, and whether surface and velocity fit together.
#pragma once

#include "scenes/scene.h"
#include "tools/commands.h"

namespace fluidtex::tools {

// Prints what the cache was taken for, where it lies, and checkMotionOf() all of its frames. Throws as
// loadScene().
void checkCache(const CommonOptions& options);

// Prints how far the surface moves in some of the frames `first` to `last` and how much of it the velocities
// explain; warns where another factor on them would do better.
void checkMotionOf(const scenes::Scene& scene, int first, int last);

}  // namespace fluidtex::tools
