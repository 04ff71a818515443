// The resolved scene: every key with its value, as JSON text.
#pragma once

#include "scenes/scene.h"

#include <string>

namespace fluidtex::scenes {

// Tables and keys as in a scene file; null where a key does not apply (`until` of a solid that stays, points
// or spacing). In front of them "quality": which one it is.
std::string resolvedText(Scene scene, Quality quality);

}  // namespace fluidtex::scenes
