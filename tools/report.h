// run.json: what ran and what it measured, frame by frame. Keys: docs/reference/files.md.
#pragma once

#include "scenes/scene.h"
#include "sim/frame/frame.h"
#include "texture/orientation/orient.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace fluidtex::tools {

using Json = nlohmann::ordered_json;

// Wall seconds of the stages of one frame.
struct StageSeconds {
  double simulate = 0.0, prepare = 0.0, transport = 0.0, synthesize = 0.0, render = 0.0, write = 0.0;
};

struct Report {
  Json scene;  // as resolved
  std::uint64_t seed = 0;
  int threads = 1;
  Json inputs = Json::object();  // see tools/input_files.h
  std::vector<Json> frames;      // one object each
};

// All about one frame but what it cost. singularities: of the orientation field; not known without a surface.
Json frameRecord(const sim::Frame& frame, const texture::TexturedSurface& surface,
                 const std::optional<std::vector<texture::Singularity>>& singularities,
                 const texture::SynthesisStats& synthesis);

// Adds to a frame's record, or brings up to date, the time it took and the program's peak memory so far.
void recordCost(Json& record, const StageSeconds& seconds);

std::string toJson(const Report& report);

// Reads back what toJson() wrote. Throws std::runtime_error when it is something else.
Report parseReport(const std::string& json);

// Why results of scene `before` (resolved) cannot be continued by scene `now`: the first key that differs,
// with both values, or empty where they agree. The number of frames may differ where the camera stands still;
// one that turns is spread over all frames. Files of keys in `inputs` are known by their content, not by
// their names.
std::string sceneDifference(const Json& before, const Json& now, const Json& inputs = Json::object());

// OUT/run.json of a run that goes on. Brought up to date when an eighth more frames are done, so that what is
// written grows with their number and not with its square; the journal has the rest.
class ReportFile {
 public:
  explicit ReportFile(std::filesystem::path out) : m_file(std::move(out) / "run.json") {}
  void frameDone(const Report& report);
  void write(const Report& report);

 private:
  std::filesystem::path m_file;
  std::size_t m_written = 0;  // frames in it
};

}  // namespace fluidtex::tools
