// The way of one frame, from motion to files, over and over: the main job.
#pragma once

#include "scenes/scene.h"

#include <atomic>
#include <filesystem>

namespace fluidtex::tools {

struct RunOptions {
  std::filesystem::path out;
  // Frames that are written and rendered, both included; earlier ones are only computed. lastFrame 0: the
  // scene's last.
  int firstFrame = 1, lastFrame = 0;
  bool resume = false;
  bool render = true;
  bool quiet = false;
  int threads = 1;
};

// Simulates, textures, renders and writes the files of docs/reference/files.md. `stop`, once true, ends the
// run by Interrupted. Wrong input is refused before anything of an earlier run is removed: UsageError (also
// where a run that is to go on began with other files, or what it wrote is no longer there),
// texture::ExemplarError, sim::MeshError. What fails on the way: sim::SolverError, std::system_error where
// the disk refuses, std::runtime_error for a damaged state, a picture or a video, openvdb::Exception from the
// grids.
void runScene(const scenes::Scene& scene, const RunOptions& options, const std::atomic<bool>& stop);

}  // namespace fluidtex::tools
