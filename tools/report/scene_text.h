// A resolved scene as the text of a scene file.
#pragma once

#include "tools/run_folder/report.h"

#include <string>

namespace fluidtex::tools {

// TOML with the keys in the order of `scene` (scenes/writer.h), without those that are null. "quality", which
// is no key of a scene file, becomes a comment.
std::string sceneText(const Json& scene);

}  // namespace fluidtex::tools
