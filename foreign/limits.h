// What a process that reads a file of others may do.
#pragma once

#include <filesystem>

namespace fluidtex::foreign {

// Seconds that reading the file may take: 6, and one more a megabyte.
int secondsFor(const std::filesystem::path& file);

// Of this process, from now on: so many seconds of processor time and three times as many in all, 1.5 GB more
// memory than it has, no byte written to a file, no core, and its end where its parent ends.
void limitThisProcess(int seconds);

}  // namespace fluidtex::foreign
