// How the heads of grids go over the socket.
#pragma once

#include "foreign/grid.h"

#include <string>
#include <string_view>
#include <vector>

namespace fluidtex::foreign {

std::string packed(const std::vector<GridHead>& heads);

// What packed() gave. Throws Unreadable where it is no such thing.
std::vector<GridHead> unpacked(std::string_view bytes);

}  // namespace fluidtex::foreign
