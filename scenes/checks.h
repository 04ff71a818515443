// What needs several keys of a scene at once: defaults that follow from other keys, and settings that do not
// go together.
#pragma once

#include "scenes/reader.h"
#include "scenes/scene.h"

namespace fluidtex::scenes {

// Fills in what was not given and has no fixed default.
void complete(Scene& scene, const Reader& reader);

// Adds a fault for each combination that cannot work. Keys that have a fault of their own already are left
// alone.
void check(const Scene& scene, Reader& reader);

}  // namespace fluidtex::scenes
