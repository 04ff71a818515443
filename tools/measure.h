// How good the texture of a finished run is, in figures: what `fluidtex measure` does.
#pragma once

#include <filesystem>

namespace fluidtex::tools {

struct MeasureWishes {
  std::filesystem::path out;       // the run's folder
  std::filesystem::path exemplar;  // empty: the run's own
  std::filesystem::path json;      // all figures go there too; empty: nowhere
  int every = 8;                   // likeness and pieces on every so-many-th frame and the last
  bool quiet = false;              // no table on stdout
};

// Reads run.json and surface/, and fills likeness, sharpness and change_along_flow of run.json. Throws
// UsageError where the folder holds no run, or its exemplar is gone.
void measureRun(const MeasureWishes& wishes);

}  // namespace fluidtex::tools
