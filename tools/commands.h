// Subcommands of the program.
#pragma once

#include "tools/command_line/command.h"

#include <filesystem>
#include <string>
#include <vector>

namespace fluidtex::tools {

// Options of every subcommand that takes a scene.
struct CommonOptions {
  std::filesystem::path scene, out, exemplar;
  std::string frames, quality = "default";
  std::vector<std::string> set;
  std::vector<std::string> formats;  // beside PLY
  std::string joints = "cut";
  int threads = 0;  // 0: one per core
  bool resume = false, noRender = false, noReport = false, follow = false, quiet = false, verbose = false;
};

// The subcommands, each in the file of its name.
Command runCommand();
Command simulateCommand();
Command textureCommand();
Command applyCommand();
Command transitionCommand();
Command compareCommand();
Command checkCommand();
Command renderCommand();
Command exportCommand();
Command measureCommand();
Command videoCommand();
Command reportCommand();
Command viewCommand();
Command validateCommand();
Command newCommand();
Command doctorCommand();
// help, version, completion, man, of the program's commands so far; the program has to outlive them.
void addHelp(Program& program);

}  // namespace fluidtex::tools
