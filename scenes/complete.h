// Defaults that follow from other keys.
#pragma once

#include "scenes/reader.h"
#include "scenes/scene.h"

namespace fluidtex::scenes {

// Fills in what was not given and has no fixed default.
void complete(Scene& scene, const Reader& reader);

}  // namespace fluidtex::scenes
