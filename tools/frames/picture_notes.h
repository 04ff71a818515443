// What a picture's file says of itself.
#pragma once

#include "render/render.h"
#include "scenes/scene.h"

#include <vector>

namespace fluidtex::tools {

// Title (the scene's name), Frame, Time (s) and Software. No dates, names of files or machines: two runs of a
// scene write the same bytes.
std::vector<render::PictureNote> pictureNotes(const scenes::Scene& scene, int frame);

}  // namespace fluidtex::tools
