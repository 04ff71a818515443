// run.json: settings and measurements of a run, frame by frame. Keys: docs/reference/files.md.
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

// Wall time of the stages of one frame, s.
struct StageSeconds {
  double simulate = 0.0, prepare = 0.0, transport = 0.0, synthesize = 0.0, render = 0.0, write = 0.0;
};

struct Report {
  Json scene;  // as resolved
  std::uint64_t seed = 0;
  int threads = 1;
  Json inputs = Json::object();  // see tools/run_folder/input_files.h
  std::vector<Json> frames;      // one object each
};

// Record of one frame, without its cost. singularities: of the orientation field; unknown without a surface.
Json frameRecord(const sim::Frame& frame, const texture::TexturedSurface& surface,
                 const std::optional<std::vector<texture::Singularity>>& singularities,
                 const texture::SynthesisStats& synthesis);

// Adds to a frame's record, or updates, the time it took and the program's peak memory so far.
void recordCost(Json& record, const StageSeconds& seconds);

std::string toJson(const Report& report);

// Parses the output of toJson(). Throws std::runtime_error for anything else.
Report parseReport(const std::string& json);

// Why scene `now` cannot continue results of scene `before` (resolved): the first key that differs, with both
// values; empty if they agree. The number of frames may differ unless the camera turns, as its turn is spread
// over all frames. Files of keys in `inputs` are compared by content, not by name.
std::string sceneDifference(const Json& before, const Json& now, const Json& inputs = Json::object());

// OUT/run.json of a run in progress. Rewritten after every eighth more frames, so that the bytes written grow
// linearly with their number; the journal has the rest.
class ReportFile {
 public:
  explicit ReportFile(const std::filesystem::path& out) : m_file(out / "run.json") {}
  void frameDone(const Report& report);
  void write(const Report& report);

 private:
  std::filesystem::path m_file;
  std::size_t m_written = 0;  // frames in it
};

}  // namespace fluidtex::tools
