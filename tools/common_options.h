// Handling of the options that subcommands share.
#pragma once

#include "scenes/scene.h"
#include "tools/commands.h"

#include <string>

namespace fluidtex::tools {

void addSceneOptions(CLI::App& command, CommonOptions& options);

// Loads the scene with quality, --set and --exemplar applied, and test-reads its mesh files. Throws
// scenes::SceneError, sim::MeshError.
scenes::Scene loadScene(const CommonOptions& options);

// Parses "A:B", "A:" or "A" into first and last, of a scene with `frames` frames; empty means all. Throws
// UsageError.
void parseFrames(const std::string& text, int frames, int& first, int& last);

}  // namespace fluidtex::tools
