// What a scene leaves to the files of another program: how many frames, how large, seen from where.
#pragma once

#include "scenes/scene.h"

#include <string>
#include <vector>

namespace fluidtex::pipeline {

// Reads the cache of scene.files and fills in what the scene does not say: voxel and first number of the
// files, frames, the domain (the bounds of the surface, without sides; of recorded frames their own) and the
// camera. Returns what was found, a line each, for people. Throws
// caches::LayoutError (also where the scene has more frames than the files) or caches::FormatError.
std::vector<std::string> takeCache(scenes::Scene& scene);

}  // namespace fluidtex::pipeline
