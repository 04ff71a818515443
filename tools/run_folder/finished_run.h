// Reads the folder of a finished run, for commands that work on it.
#pragma once

#include "texture/exemplar/exemplar.h"
#include "tools/run_folder/report.h"

#include <filesystem>
#include <string_view>
#include <vector>

namespace fluidtex::tools {

struct FinishedRun {
  std::filesystem::path out;
  Json report;                     // run.json
  std::filesystem::path exemplar;  // the image's name
  texture::Image color;            // and its pixels, linear RGBA
  bool toroidal = false;
  bool looksUp = false;      // colours were looked up at exemplar coordinates
  bool isProjected = false;  // from rest positions: there are no coordinates
  // moves: the exemplar is an image sequence, and `color` its first image. movesWithTime: one image per
  // frame, chosen by time; otherwise guidance chooses one per vertex.
  bool moves = false, movesWithTime = false;
  std::vector<int> frames;  // with a surface on disk, ascending; never empty
  std::filesystem::path surfaceOf(int frame) const;
};

// run.json. Frames that it lacks, since the run was killed or is still running, are added from the journal.
// Throws UsageError if run.json is missing or is no report of a run.
Json readReport(const std::filesystem::path& out);

// Frames whose file is in the folder, ascending. extension: with its dot.
std::vector<int> framesIn(const std::filesystem::path& folder, std::string_view extension);

// The report's record of a frame; null if there is none.
const Json* recordOf(const FinishedRun& run, int frame);
Json* recordOf(FinishedRun& run, int frame);

// The frame's spacing from the report, metres; else from area / points, as one vertex stands for one texel.
double spacingOf(const FinishedRun& run, const texture::TexturedSurface& surface, int frame);

// The same for a surface in the folder of a run whose report may be missing.
double spacingOf(const std::filesystem::path& out, const texture::TexturedSurface& surface, int frame);

// Returns the folder if it exists; commands that work on a run create none. Throws UsageError otherwise.
const std::filesystem::path& existing(const std::filesystem::path& out);

// Whether colours were looked up at exemplar coordinates, by run.json's settings of the texture.
bool looksUp(std::string_view method, std::string_view laterFrames);

// exemplar: image that replaces the run's own. Empty: the run's own or, where that is missing, its copy in
// the folder. Throws UsageError if the folder holds no run or no surface, the exemplar is missing, or the
// given one has another size than the halved picture of a run with [texture.start]; ExemplarError if it
// cannot be read.
FinishedRun openRun(const std::filesystem::path& out, const std::filesystem::path& exemplar);

}  // namespace fluidtex::tools
