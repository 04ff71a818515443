// fluidtex measure: quality measures of a finished run's texture.
#pragma once

#include <filesystem>

namespace fluidtex::tools {

struct MeasureWishes {
  std::filesystem::path out;       // the run's folder
  std::filesystem::path exemplar;  // empty: the run's own
  std::filesystem::path json;      // file for all measures; empty: none
  std::filesystem::path motion;    // folder for unlit pictures and motion vectors; empty: none
  int every = 8;                   // likeness and pieces on every so-many-th frame, and on the last
  bool quiet = false;              // no table on stdout
};

// Reads run.json and surface/, and fills likeness, sharpness, pop and change_along_flow of run.json;
// report.html, if there is one, is written anew. Throws UsageError if the folder holds no run, or its
// exemplar is missing.
void measureRun(const MeasureWishes& wishes);

}  // namespace fluidtex::tools
