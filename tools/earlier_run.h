// What an earlier run has left in the out folder. Only what a run writes itself is touched; the user's own
// files in the same folders stay.
#pragma once

#include <filesystem>
#include <string>

namespace fluidtex::tools {

// Removes all temporary files and folders that a killed run left behind.
void removeLeftovers(const std::filesystem::path& out);

// Makes the folder where it is missing and removes frames, surfaces, states, report, video and log of an
// earlier run of the scene. The state goes first: a kill on the way leaves nothing that could be continued
// wrongly.
void clearEarlierRun(const std::filesystem::path& out, const std::string& sceneName);

// The first of the files frames first..last should have left that is not there, relative to `out`; empty if
// there is none. Pictures are asked for only where `rendered`.
std::filesystem::path missingResult(const std::filesystem::path& out, int first, int last, bool rendered);

}  // namespace fluidtex::tools
