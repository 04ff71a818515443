#include "caches/recorded/recording.h"

#include "caches/layouts/numbered_files.h"
#include "caches/recorded/recorded_frame.h"
#include "sim/grid/mac_grid.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

namespace fluidtex::caches {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kFormat = "fluidtex cache 1";

bool isThere(const fs::path& file) {
  std::error_code unknown;
  return fs::is_regular_file(file, unknown);
}

Json parsed(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return Json::parse(std::string(std::istreambuf_iterator<char>(in), {}), nullptr, false);
}

}  // namespace

fs::path recordedFrame(const fs::path& folder, int frame) {
  return folder / fmt::format("frame_{:04d}.vdb", frame);
}

std::string recordingText(const sim::Options& options) {
  Json json;
  json["format"] = kFormat;
  json["size"] = {options.size[0], options.size[1], options.size[2]};
  json["resolution"] = options.resolution;
  for (const sim::Side side : options.sides) json["sides"].push_back(int(side));
  json["frame_rate"] = options.frameRate;
  return json.dump(1) + "\n";
}

bool isRecording(const fs::path& folder) {
  const fs::path file = folder / kRecordingFile;
  if (!isThere(file)) return false;
  const Json json = parsed(file);
  return json.is_object() && json.contains("format") && json["format"].is_string() &&
         json["format"].get<std::string>().starts_with("fluidtex cache");
}

Recording openRecording(const fs::path& folder) {
  Recording recording{folder, 0, {}};
  const fs::path file = folder / kRecordingFile;
  try {
    const Json json = parsed(file);
    if (json.at("format") != kFormat)
      throw LayoutError(file.string() + ": was written by another version; simulate again");
    for (std::size_t axis = 0; axis < 3; ++axis)
      recording.sim.size[int(axis)] = json.at("size").at(axis).get<double>();
    recording.sim.resolution = json.at("resolution").get<int>();
    for (std::size_t side = 0; side < recording.sim.sides.size(); ++side)
      recording.sim.sides[side] = sim::Side(json.at("sides").at(side).get<int>());
    recording.sim.frameRate = json.at("frame_rate").get<double>();
  } catch (const Json::exception& error) {
    throw LayoutError(file.string() + ": is damaged (" + error.what() + "); simulate again");
  }
  while (isThere(recordedFrame(folder, recording.frames + 1))) ++recording.frames;
  if (recording.frames == 0)
    throw LayoutError(recordedFrame(folder, 1).string() + ": is missing; simulate again");
  return recording;
}

RecordedFlow::RecordedFlow(Recording recording, const sim::State& state) : m_recording(std::move(recording)) {
  const double h = m_recording.sim.voxelSize();
  m_state.frame = state.frame;
  m_state.time = state.time;
  m_state.phi = sim::makePhi(h, float(h));
  m_state.velocity = sim::makeVelocity(h);
}

sim::Frame RecordedFlow::next(const std::function<void(double)>& progress) {
  const fs::path file = recordedFrame(m_recording.folder, m_state.frame + 1);
  if (!isThere(file))
    throw LayoutError(file.string() + fmt::format(": is missing; {} frames are there", m_recording.frames));
  sim::Frame frame = readRecordedFrame(file);
  if (frame.index != m_state.frame + 1)
    throw LayoutError(file.string() +
                      fmt::format(": is frame {} by what it says; simulate again", frame.index));
  m_state.frame = frame.index;
  m_state.time = frame.time;
  if (progress) progress(1.0);
  return frame;
}

}  // namespace fluidtex::caches
