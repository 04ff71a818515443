// What fluidtex run has left in a folder, for commands that work on it afterwards.
#pragma once

#include "texture/exemplar/exemplar.h"
#include "tools/report.h"

#include <filesystem>
#include <vector>

namespace fluidtex::tools {

struct FinishedRun {
  std::filesystem::path out;
  Json report;                     // run.json
  std::filesystem::path exemplar;  // the image's name
  texture::Image color;            // and its pixels, linear RGBA
  bool toroidal = false;
  std::vector<int> frames;  // whose surface is there, ascending; never none
  std::filesystem::path surfaceOf(int frame) const;
};

// What the report says of a frame; null where it says nothing.
const Json* recordOf(const FinishedRun& run, int frame);
Json* recordOf(FinishedRun& run, int frame);

// The frame's spacing, metres, as the report says; or else of as many squares as the surface has points,
// since one vertex shows a texel.
double spacingOf(const FinishedRun& run, const texture::TexturedSurface& surface, int frame);

// The same for a surface in the folder of a run whose report may be gone.
double spacingOf(const std::filesystem::path& out, const texture::TexturedSurface& surface, int frame);

// The folder as it is given, if it is one: what works on a run makes none. Throws UsageError.
const std::filesystem::path& existing(const std::filesystem::path& out);

// `exemplar`: instead of the run's own, where that is no longer at its place; else empty. Throws UsageError
// where the folder holds no run, or its exemplar is gone.
FinishedRun openRun(const std::filesystem::path& out, const std::filesystem::path& exemplar);

}  // namespace fluidtex::tools
