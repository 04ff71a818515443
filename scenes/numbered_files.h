// Files of a pattern that numbers them.
#pragma once

#include <filesystem>
#include <vector>

namespace fluidtex::scenes {

struct NumberedFiles {
  int first = 0;                             // lowest number that is there
  std::vector<std::filesystem::path> files;  // from there on, until a number is missing
  std::filesystem::path missing;             // the first that is, where there are files of higher numbers
};

// pattern: its last part has %d, or %04d for four digits. No files where the folder cannot be read.
NumberedFiles numberedFiles(const std::filesystem::path& pattern);

// Whether the name has a place for a number and is no file as it stands ("50%.png" may be one).
bool isPattern(const std::filesystem::path& fileOrPattern);

// The first file of a pattern; any other name as it is.
std::filesystem::path firstOf(const std::filesystem::path& fileOrPattern);

}  // namespace fluidtex::scenes
