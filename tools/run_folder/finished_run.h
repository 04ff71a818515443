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
  // The exemplar is a sequence, and `color` its first picture; a frame shows one of them, or places differ.
  bool moves = false, movesWithTime = false;
  std::vector<int> frames;  // with a surface on disk, ascending; never empty
  std::filesystem::path surfaceOf(int frame) const;
};

// run.json, and of a run that was killed or goes on the frames that it lacks, from the journal. Throws
// UsageError if the folder holds none, or one that is damaged.
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

// exemplar: replaces the run's own; else empty. Where that is no longer at its place, the copy in the folder
// is taken. Throws UsageError if the folder holds no run, or its exemplar is missing.
FinishedRun openRun(const std::filesystem::path& out, const std::filesystem::path& exemplar);

}  // namespace fluidtex::tools
