// Reads the arguments of the program.
#pragma once

#include "tools/command_line/command.h"

#include <string>

namespace fluidtex::tools {

// What the arguments ask for: a command to run, or a text to print.
struct Asked {
  const Command* command = nullptr;
  std::string text;  // where there is no command: help, or the version
};

// Puts the arguments into the targets of the command that they name. Throws UsageError, one sentence, where
// they do not fit, with what would.
Asked parse(const Program& program, int argc, const char* const* argv);

// What --help prints: of a command, or of the program where the name is empty.
std::string helpOf(const Program& program, const std::string& command);

}  // namespace fluidtex::tools
