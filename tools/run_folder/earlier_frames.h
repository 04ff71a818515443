// What a resumed run takes over from the run before.
#pragma once

#include "scenes/scene.h"
#include "sim/step/solver.h"
#include "texture/surface.h"
#include "tools/run_folder/report.h"
#include "tools/run_folder/run_options.h"

#include <optional>
#include <vector>

namespace fluidtex::tools {

struct EarlierFrames {
  sim::State solver;                 // after the last of them
  texture::TexturedSurface surface;  // of the last of them
  std::vector<Json> records;         // of all, from frame 1 on
  bool writeLastAgain = false;       // files of the last are lost or changed
};

// Looks in options.out for finished frames, up to the scene's last one `last`, and removes temporary files of
// a killed run. now: report of this run, without frames. Nothing if there is nothing to resume. Throws
// UsageError if the scene or its files differ, or a file of a finished frame is missing or changed (of the
// last finished frame writeLastAgain is set instead); std::runtime_error for a damaged state or a journal
// that lacks a frame; openvdb::IoError if the solver's file is intact but no state.
std::optional<EarlierFrames> earlierFrames(const scenes::Scene& scene, const RunOptions& options,
                                           const Report& now, int last);

}  // namespace fluidtex::tools
