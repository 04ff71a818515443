// Waiting for the files of a program that still runs.
#pragma once

#include "caches/layouts/layout.h"

#include <filesystem>
#include <optional>

namespace fluidtex::caches {

// A file of this frame that is not there yet, or that may still be written: there is none of the next frame,
// and it is empty or changed within the last two seconds. Nothing once all are whole, which the layout then
// has. Throws LayoutError where a folder cannot be listed, or files have one number twice.
std::optional<std::filesystem::path> awaitedFile(Layout& layout, int number);

}  // namespace fluidtex::caches
