// The video of a run's pictures.
#pragma once

#include "scenes/scene.h"

#include <atomic>
#include <filesystem>
#include <string>

namespace fluidtex::tools {

std::filesystem::path videoFile(const scenes::Scene& scene, const std::filesystem::path& out);

// Encodes the pictures first..last of out/frames to videoFile(), at the scene's frame rate. If that fails
// (encoder, full disk), throws std::runtime_error, or Interrupted(onward) where `stop` is set. onward:
// command-line option with which the run can be continued.
void writeVideo(const scenes::Scene& scene, const std::filesystem::path& out, int first, int last,
                const std::atomic<bool>& stop, const std::string& onward);

}  // namespace fluidtex::tools
