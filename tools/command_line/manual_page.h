// The manual page.
#pragma once

#include "tools/command_line/command.h"

#include <string>

namespace fluidtex::tools {

// In the macros of man(7), section 1.
std::string manualPage(const Program& program);

}  // namespace fluidtex::tools
