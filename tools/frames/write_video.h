// The video of a run's pictures.
#pragma once

#include "scenes/scene.h"

#include <atomic>
#include <filesystem>
#include <string>

namespace fluidtex::tools {

std::filesystem::path videoFile(const scenes::Scene& scene, const std::filesystem::path& out);

// The pictures first..last of out/frames as videoFile(), at the scene's frame rate. Where the encoder fails
// or the disk is full, throws std::runtime_error, or Interrupted where `stop` is set, of which `onward` is
// the option that goes on.
void writeVideo(const scenes::Scene& scene, const std::filesystem::path& out, int first, int last,
                const std::atomic<bool>& stop, const std::string& onward);

}  // namespace fluidtex::tools
