// Files of an earlier run in the out folder. Only files that a run writes are touched; the user's own files
// in the same folders stay.
#pragma once

#include "scenes/scene.h"
#include "tools/run_folder/journal.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace fluidtex::tools {

// Removes all temporary files and folders of a killed run.
void removeLeftovers(const std::filesystem::path& out);

// Creates the folder if missing, and removes frames, surfaces in every format, states, journal, report,
// video, the exemplar's copy and log of an earlier run of the scene. The state goes first, so that a kill in
// between leaves nothing that could be resumed wrongly.
void clearEarlierRun(const std::filesystem::path& out, const std::string& sceneName);

// What a run writes of each frame besides its surface.
struct FrameFiles {
  bool picture = false;
  bool onto = false;      // the scene's own mesh
  bool exemplar = false;  // the picture of an exemplar that moves
};

FrameFiles frameFilesOf(const scenes::Scene& scene, bool rendered);

// Files of a frame, relative to `out`.
std::vector<std::string> resultsOf(int frame, const FrameFiles& files);

struct Broken {
  int frame = 0;
  std::string name;      // relative to `out`
  bool there = false;    // it exists, but not as the run wrote it
  bool written = false;  // by the run, and lost or changed since; else it was never requested
};

// The first result of frames first..last that is not as the journal says.
std::optional<Broken> firstBroken(const std::filesystem::path& out, const Journal& journal, int first,
                                  int last, const FrameFiles& files);

}  // namespace fluidtex::tools
