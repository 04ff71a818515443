// fluidtex run, for a loaded scene.
#pragma once

#include "scenes/scene.h"
#include "tools/commands.h"

namespace fluidtex::tools {

// Runs the scene into the folder, with threads, log file and Ctrl-C as on the command line. Throws as
// runScene().
void runInto(const std::filesystem::path& out, const scenes::Scene& scene, const CommonOptions& options);

}  // namespace fluidtex::tools
