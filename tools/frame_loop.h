// The main loop: frame by frame from motion to files.
#pragma once

#include "scenes/scene.h"

#include <atomic>
#include <filesystem>

namespace fluidtex::tools {

struct RunOptions {
  std::filesystem::path out;
  // Frames to write and render, inclusive; earlier ones are only computed. lastFrame 0: the scene's last.
  int firstFrame = 1, lastFrame = 0;
  bool resume = false;
  bool render = true;
  bool quiet = false;
  int threads = 1;
};

// Simulates, textures, renders and writes the files of docs/reference/files.md. Setting `stop` ends the run
// with Interrupted.
// Invalid input is rejected before anything of an earlier run is removed: UsageError (also if a run to be
// resumed began with other files, or its output is missing), texture::ExemplarError, sim::MeshError. Later
// failures: sim::SolverError, std::system_error of the disk, std::runtime_error for a damaged state, a
// picture or a video, openvdb::Exception of the grids.
void runScene(const scenes::Scene& scene, const RunOptions& options, const std::atomic<bool>& stop);

}  // namespace fluidtex::tools
