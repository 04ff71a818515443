// A folder of the program's own frames: frame_0001.vdb, ..., and cache.json with what they are of.
#pragma once

#include "caches/options.h"
#include "sim/frame/frame.h"
#include "sim/options.h"
#include "sim/step/liquid.h"

#include <filesystem>
#include <functional>

namespace fluidtex::caches {

struct Recording {
  std::filesystem::path folder;
  int frames = 0;  // there are, from 1 on without a gap
  // Of the domain: size, sides and resolution; and the frames a second.
  sim::Options sim;
};

std::filesystem::path recordedFrame(const std::filesystem::path& folder, int frame);

// Text of kRecordingFile.
std::string recordingText(const sim::Options& options);

// Whether a folder is a recording.
bool isRecording(const std::filesystem::path& folder);

// Throws LayoutError where cache.json is damaged, or the first frame is missing.
Recording openRecording(const std::filesystem::path& folder);

// Motion out of a recording: the frames as the solver gave them.
class RecordedFlow {
 public:
  // Goes on after the frame of a state, if any.
  explicit RecordedFlow(Recording recording, const sim::State& state = {});

  // Throws LayoutError: beyond the last frame, or as readRecordedFrame().
  sim::Frame next(const std::function<void(double)>& progress = {});

  // Its grids are empty.
  const sim::State& state() const { return m_state; }

 private:
  Recording m_recording;
  sim::State m_state;
};

}  // namespace fluidtex::caches
