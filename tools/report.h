// run.json: what ran and what it measured, frame by frame. Keys: docs/formats.md.
#pragma once

#include "scenes/scene.h"
#include "sim/frame.h"
#include "texture/surface.h"

#include <optional>
#include <string>
#include <vector>

namespace fluidtex::tools {

// Wall seconds of the stages of one frame.
struct StageSeconds {
  double simulate = 0.0, prepare = 0.0, transport = 0.0, synthesize = 0.0, render = 0.0, write = 0.0;
};

struct Report {
  std::string scene;  // as resolved, JSON
  std::uint64_t seed = 0;
  int threads = 1;
  std::vector<std::string> frames;  // one JSON object each
};

std::string frameRecord(const sim::Frame& frame, const texture::TexturedSurface& surface,
                        std::optional<int> singularities, const texture::SynthesisStats& synthesis,
                        const StageSeconds& seconds);

std::string toJson(const Report& report);

// Reads back what toJson() wrote. Throws std::runtime_error when it is something else.
Report parseReport(const std::string& json);

// Why results of scene `before` (resolved, JSON) cannot be continued by scene `now`: the first key that
// differs, with both values, or empty where they agree. The number of frames may differ.
std::string sceneDifference(const std::string& before, const std::string& now);

}  // namespace fluidtex::tools
