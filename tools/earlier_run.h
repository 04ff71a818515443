// What an earlier run has left in the out folder. Only what a run writes itself is touched; the user's own
// files in the same folders stay.
#pragma once

#include "tools/journal.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace fluidtex::tools {

// Removes all temporary files and folders that a killed run left behind.
void removeLeftovers(const std::filesystem::path& out);

// Makes the folder where it is missing and removes frames, surfaces, states, journal, report, video and log
// of an earlier run of the scene. The state goes first: a kill on the way leaves nothing that could be
// continued wrongly.
void clearEarlierRun(const std::filesystem::path& out, const std::string& sceneName);

// What a frame leaves, relative to `out`: its surface, its picture where `rendered`, the scene's own mesh
// where `onto`.
std::vector<std::string> resultsOf(int frame, bool rendered, bool onto);

struct Broken {
  int frame = 0;
  std::string name;      // relative to `out`
  bool there = false;    // but not as the run wrote it
  bool written = false;  // by the run, and lost or changed since; else it was never asked for
};

// The first result of frames first..last that is not as the journal says.
std::optional<Broken> firstBroken(const std::filesystem::path& out, const Journal& journal, int first,
                                  int last, bool rendered, bool onto);

}  // namespace fluidtex::tools
