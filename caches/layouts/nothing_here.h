// What to do instead where a folder holds nothing that is read.
#pragma once

#include <filesystem>
#include <string>

namespace fluidtex::caches {

// A sentence about the folder, or about a file in it: files of a kind that is not read, folders below that
// are caches, or neither.
std::string nothingHere(const std::filesystem::path& folder);

}  // namespace fluidtex::caches
