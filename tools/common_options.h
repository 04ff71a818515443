// Options that the subcommands share, and how a command answers to errors.
#pragma once

#include "scenes/scene.h"
#include "tools/commands.h"

#include <functional>

namespace fluidtex::tools {

void addSceneOptions(CLI::App& command, CommonOptions& options);

// Loads the scene with quality, --set and --exemplar applied. Throws scenes::SceneError.
scenes::Scene loadScene(const CommonOptions& options);

// Reads "A:B", "A:" or "A" into first and last (0: the scene's last). Throws UsageError.
void parseFrames(const std::string& text, int frames, int& first, int& last);

// Calls body; every exception becomes its sentence on stderr (all the faults of a scene, a line each) and an
// exit code.
int guarded(const std::function<void()>& body);

}  // namespace fluidtex::tools
