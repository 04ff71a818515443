// The manual page.
#pragma once

#include "tools/command_line/described.h"

#include <string>

namespace fluidtex::tools {

// In the macros of man(7), section 1. version: of the program, for the page's foot.
std::string manualPage(const DescribedProgram& program, const std::string& version);

}  // namespace fluidtex::tools
