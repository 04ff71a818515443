// The main loop: frame by frame from motion to files.
#pragma once

#include "scenes/scene.h"
#include "tools/run_folder/run_options.h"

#include <atomic>

namespace fluidtex::tools {

// Simulates, textures, renders and writes the files of docs/reference/files.md. Setting `stop` ends the run
// with Interrupted.
// Invalid input is rejected before anything of an earlier run is removed: UsageError (also if a run to be
// resumed began with other files, or its output is missing), texture::ExemplarError, sim::MeshError. Later
// failures: sim::SolverError, std::system_error of the disk, std::runtime_error for a damaged state, a
// picture or a video, openvdb::Exception of the grids.
void runScene(const scenes::Scene& scene, const RunOptions& options, const std::atomic<bool>& stop);

}  // namespace fluidtex::tools
