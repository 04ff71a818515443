// Options that the subcommands share, and what they do with them alike.
#pragma once

#include "scenes/scene.h"
#include "tools/commands.h"

#include <string>

namespace fluidtex::tools {

void addSceneOptions(CLI::App& command, CommonOptions& options);

// Loads the scene with quality, --set and --exemplar applied, and tries its mesh files. Throws
// scenes::SceneError, sim::MeshError.
scenes::Scene loadScene(const CommonOptions& options);

// Reads "A:B", "A:" or "A" into first and last, of a scene with `frames` frames; nothing means all of them.
// Throws UsageError.
void parseFrames(const std::string& text, int frames, int& first, int& last);

}  // namespace fluidtex::tools
