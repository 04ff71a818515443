// What `fluidtex run` does with a loaded scene.
#pragma once

#include "scenes/scene.h"
#include "tools/commands.h"

namespace fluidtex::tools {

// Runs the scene into the folder: threads, log file and Ctrl-C as the command line and the user have it.
// Throws as runScene() does.
void runInto(const std::filesystem::path& out, const scenes::Scene& scene, const CommonOptions& options);

}  // namespace fluidtex::tools
