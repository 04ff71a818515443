// What a scene leaves to the files of another program: how many frames, how large, seen from where.
#pragma once

#include "caches/liquid/survey.h"
#include "scenes/scene.h"

namespace fluidtex::pipeline {

// Reads the cache of scene.files and fills in what the scene does not say: voxel and first number of the
// files, frames, the domain (the bounds of the surface, without sides) and the camera. Throws
// caches::LayoutError (also where the scene has more frames than the files) or caches::FormatError.
caches::Survey takeCache(scenes::Scene& scene);

}  // namespace fluidtex::pipeline
