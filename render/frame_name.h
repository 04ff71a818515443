// The number of a frame as it stands in the names of files and folders.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace fluidtex::render {

// Four digits at least: "0007".
std::string frameName(int frame);

// The frame, 0 or more, whose frameName() this is; nothing for every other text.
std::optional<int> frameNumber(std::string_view name);

}  // namespace fluidtex::render
