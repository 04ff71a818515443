// What a run that goes on has from the run before it.
#pragma once

#include "scenes/scene.h"
#include "sim/step/solver.h"
#include "texture/surface.h"
#include "tools/frame_loop.h"
#include "tools/report.h"

#include <optional>
#include <vector>

namespace fluidtex::tools {

struct EarlierFrames {
  sim::State solver;                 // after the last of them
  texture::TexturedSurface surface;  // of the last of them
  std::vector<Json> records;         // of all, from frame 1 on
  bool writeLastAgain = false;       // files of the last are lost or changed
};

// Looks through options.out for frames that are done, up to the scene's last one `last`, and removes what a
// killed run left half-written. now: the report of this run, still without frames. Nothing where there is
// none to go on from. Throws UsageError where the scene or its files are others, or a file of a frame is not
// as it was written, and std::runtime_error for a damaged state.
std::optional<EarlierFrames> earlierFrames(const scenes::Scene& scene, const RunOptions& options,
                                           const Report& now, int last);

}  // namespace fluidtex::tools
