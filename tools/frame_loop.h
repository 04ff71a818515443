// The way of one frame, from motion to files, over and over: the main job.
#pragma once

#include "scenes/scene.h"

#include <atomic>
#include <filesystem>
#include <stdexcept>

namespace fluidtex::tools {

struct RunOptions {
  std::filesystem::path out;
  int firstFrame = 1,
      lastFrame =
          0;  // written and rendered, inclusive; earlier ones are only computed. last 0: the scene's last
  bool resume = false;
  bool render = true;
  bool quiet = false;
  int threads = 1;
};

// The user's wishes do not fit the scene or what lies in the out folder; one sentence.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Stopped on request; the state of the last whole frame is on disk.
struct Interrupted : std::runtime_error {
  Interrupted() : std::runtime_error("interrupted; --resume goes on from the last finished frame") {}
};

// Simulates, textures, renders and writes the files of docs/formats.md. `stop`, once true, ends the run by
// Interrupted. Throws UsageError, texture::ExemplarError, sim::SolverError, std::system_error.
void runScene(const scenes::Scene& scene, const RunOptions& options, const std::atomic<bool>& stop);

}  // namespace fluidtex::tools
