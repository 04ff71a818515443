#include "tools/frames/write_video.h"

#include "render/frame_name.h"
#include "render/render.h"
#include "tests/file_limit.h"
#include "tests/scratch.h"
#include "tests/video_probe.h"
#include "tools/base/errors.h"

#include <catch2/catch.hpp>

using namespace fluidtex;
using namespace fluidtex::tools;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

scenes::Scene riverScene() {
  scenes::Scene scene;
  scene.name = "river";
  scene.sim.frameRate = 30.0;
  return scene;
}

// The frames of a run that differ.
void writeFrames(const fs::path& out, int first, int last) {
  fs::create_directories(out / "frames");
  for (int frame = first; frame <= last; ++frame)
    render::writePng({32, 18, std::vector<float>(32 * 18 * 3, 0.1f * float(frame))},
                     out / "frames" / (render::frameName(frame) + ".png"));
}

}  // namespace

TEST_CASE("write video: it bears the scene's name, and lies in the run's folder", "[tools]") {
  CHECK(videoFile(riverScene(), "runs/a") == fs::path("runs/a/river.mp4"));
}

TEST_CASE("write video: the pictures asked for, at the scene's rate, and nothing else in the folder",
          "[tools]") {
  const Scratch scratch;
  writeFrames(scratch.path, 1, 5);
  const std::atomic<bool> stop = false;
  writeVideo(riverScene(), scratch.path, 2, 4, stop, "--resume");
  const fs::path video = scratch.path / "river.mp4";
  CHECK(probe(video, "nb_read_frames") == "3");
  CHECK(probe(video, "r_frame_rate") == "30/1");
  CHECK(filesIn(scratch.path) == std::vector<std::string>{"frames/0001.png", "frames/0002.png",
                                                          "frames/0003.png", "frames/0004.png",
                                                          "frames/0005.png", "river.mp4"});
}

TEST_CASE("write video: where it fails, the last one stays and nothing half written is left", "[tools]") {
  const Scratch scratch;
  writeFrames(scratch.path, 1, 3);
  std::ofstream(scratch.path / "river.mp4") << "of an earlier run";
  const std::vector<std::string> before = filesIn(scratch.path);
  const std::atomic<bool> stop = false;
  CHECK_THROWS_WITH(writeVideo(riverScene(), scratch.path, 1, 4, stop, "--resume"),
                    Contains("0004.png is missing"));
  {
    const FileLimit less(100);
    CHECK_THROWS_AS(writeVideo(riverScene(), scratch.path, 1, 3, stop, "--resume"), std::runtime_error);
  }
  CHECK(filesIn(scratch.path) == before);
  CHECK(readBytes(scratch.path / "river.mp4") == "of an earlier run");
}

TEST_CASE("write video: an encoder that ends because of a stop is no failure of its own", "[tools]") {
  const Scratch scratch;
  writeFrames(scratch.path, 1, 1);
  const std::atomic<bool> stop = true;
  CHECK_THROWS_AS(writeVideo(riverScene(), scratch.path, 1, 2, stop, "--from=7"), Interrupted);
  CHECK_THROWS_WITH(writeVideo(riverScene(), scratch.path, 1, 2, stop, "--from=7"), Contains("--from=7"));
  CHECK_FALSE(fs::exists(scratch.path / "river.mp4"));
  // What was finished all the same is there.
  writeVideo(riverScene(), scratch.path, 1, 1, stop, "--from=7");
  CHECK(probe(scratch.path / "river.mp4", "nb_read_frames") == "1");
}
