// What the command line says about a run.
#pragma once

#include "tools/formats/exports.h"

#include <filesystem>
#include <vector>

namespace fluidtex::tools {

struct RunOptions {
  std::filesystem::path out;
  // Frames to write and render, inclusive; earlier ones are only computed. lastFrame 0: the scene's last.
  int firstFrame = 1, lastFrame = 0;
  bool resume = false;
  bool render = true;
  bool quiet = false;
  int threads = 1;
  std::vector<Format> formats{Format::ply};
  JointsAs joints = JointsAs::cut;
};

}  // namespace fluidtex::tools
