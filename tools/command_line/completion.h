// Completion for shells.
#pragma once

#include "tools/command_line/command.h"

#include <string>
#include <vector>

namespace fluidtex::tools {

inline const std::vector<std::string> kShells = {"bash", "zsh", "fish"};

// The script by which the shell, one of kShells, completes subcommands, options, their words, files and
// folders. keys: of a scene, for KEY=VALUE.
std::string completionScript(const Program& program, const std::vector<std::string>& keys,
                             const std::string& shell);

}  // namespace fluidtex::tools
