#include "caches/recorded/recording.h"

#include "caches/layouts/numbered_files.h"
#include "caches/recorded/recorded_frame.h"
#include "sim/step/solver.h"
#include "tests/scratch.h"

#include <catch2/catch.hpp>

using namespace fluidtex;
using namespace fluidtex::caches;

namespace {

sim::Options ball() {
  sim::Options options;
  options.size = sim::Vec3d(0.75, 0.5, 0.5);
  options.resolution = 12;
  options.frameRate = 30.0;
  options.sides[5] = sim::Side::open;
  options.liquid.push_back({.shape = {sim::Sphere{{0.3, 0.25, 0.25}, 0.15}}});
  return options;
}

void write(const std::filesystem::path& folder, int frames) {
  sim::Solver solver(ball());
  for (int frame = 1; frame <= frames; ++frame)
    writeRecordedFrame(solver.next(), ball().voxelSize(), recordedFrame(folder, frame));
  std::ofstream(folder / kRecordingFile) << recordingText(ball());
}

}  // namespace

TEST_CASE("recording: says what domain it is of, and how many frames are there", "[caches]") {
  const Scratch scratch;
  CHECK_FALSE(isRecording(scratch.path));
  write(scratch.path, 2);
  REQUIRE(isRecording(scratch.path));
  const Recording recording = openRecording(scratch.path);
  CHECK(recording.frames == 2);
  CHECK(recording.sim.size == ball().size);
  CHECK(recording.sim.resolution == 12);
  CHECK(recording.sim.frameRate == 30.0);
  CHECK(recording.sim.sides == ball().sides);
}

TEST_CASE("recording: frames come in order, go on from a state, and end", "[caches]") {
  const Scratch scratch;
  write(scratch.path, 3);
  RecordedFlow whole(openRecording(scratch.path));
  CHECK(whole.next().index == 1);
  CHECK(whole.next().time == Approx(1.0 / 30.0));
  RecordedFlow rest(openRecording(scratch.path), whole.state());
  CHECK(rest.next().index == 3);
  CHECK_THROWS_AS(rest.next(), LayoutError);
}

TEST_CASE("recording: a damaged one is refused", "[caches]") {
  const Scratch scratch;
  write(scratch.path, 1);
  std::ofstream(scratch.path / kRecordingFile) << "{\"format\": \"fluidtex cache 1\", \"size\": [1]}";
  CHECK_THROWS_AS(openRecording(scratch.path), LayoutError);
  std::ofstream(scratch.path / kRecordingFile) << "{\"format\": \"fluidtex cache 9\"}";
  CHECK_THROWS_AS(openRecording(scratch.path), LayoutError);
  write(scratch.path, 1);
  std::filesystem::remove(recordedFrame(scratch.path, 1));
  CHECK_THROWS_AS(openRecording(scratch.path), LayoutError);
}
