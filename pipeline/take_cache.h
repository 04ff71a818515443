// Completes a scene from the cache of another program.
#pragma once

#include "scenes/scene.h"

#include <string>
#include <vector>

namespace fluidtex::pipeline {

// Reads the cache of scene.files and sets files.voxel, files.first and, of particles, files.radius. Where the
// scene does not give them, also sets the number of frames, the domain (bounds of the surface, without sides;
// of recorded frames their own) and the camera. Returns a description for the user, one string a line. Throws
// caches::FormatError, and caches::LayoutError: also where the scene has more frames than the files, where
// the texture follows an attribute that the files lack, and with files.follow where the number of frames is
// not given or the frames are recorded ones.
std::vector<std::string> takeCache(scenes::Scene& scene);

}  // namespace fluidtex::pipeline
