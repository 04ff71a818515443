#include "render/frame_name.h"
#include "render/render.h"
#include "tests/file_limit.h"
#include "tests/scratch.h"
#include "tests/video_probe.h"

#include <catch2/catch.hpp>

#include <cstdlib>
#include <fstream>

using namespace fluidtex::render;
namespace fs = std::filesystem;

namespace {

// A folder in `scratch` with frames FIRST..LAST in which the brightness rises.
fs::path frames(const Scratch& scratch, const std::string& name, int first, int last, int width, int height) {
  const fs::path folder = scratch.path / name;
  fs::create_directories(folder);
  for (int frame = first; frame <= last; ++frame) {
    const float grey = 0.1f * static_cast<float>(frame - first + 1);
    writePng({width, height, std::vector<float>(static_cast<std::size_t>(width) * height * 3, grey)},
             folder / (frameName(frame) + ".png"));
  }
  return folder;
}

}  // namespace

TEST_CASE("video: frames, size, rate, format and colours are as said", "[render]") {
  const Scratch scratch;
  const fs::path folder = frames(scratch, "plain", 3, 7, 64, 36);
  const fs::path video = folder / "out.tmp";
  writeVideo(folder, 3, 7, 24.0, video);
  REQUIRE(probe(video, "nb_read_frames") == "5");
  REQUIRE(probe(video, "codec_name,width,height,pix_fmt") == "h264,64,36,yuv420p");
  REQUIRE(probe(video, "r_frame_rate") == "24/1");
  REQUIRE(probe(video, "color_range,color_space,color_transfer,color_primaries") == "tv,bt709,bt709,bt709");
}

TEST_CASE("video: odd sizes and names with special characters work", "[render]") {
  const Scratch scratch;
  const fs::path folder = frames(scratch, "odd %03d 'x' $HOME", 1, 2, 33, 17);
  const fs::path video = folder / "a b.mp4";
  writeVideo(folder, 1, 2, 29.97, video);
  REQUIRE(readBytes(video).size() > 200);
  fs::rename(video, folder.parent_path() / "odd.mp4");
  REQUIRE(probe(folder.parent_path() / "odd.mp4", "nb_read_frames,width,height") == "32,16,2");
}

TEST_CASE("video: the same frames give the same bytes", "[render]") {
  const Scratch scratch;
  const fs::path folder = frames(scratch, "twice", 1, 4, 48, 48);
  writeVideo(folder, 1, 4, 24.0, folder / "a.mp4");
  writeVideo(folder, 1, 4, 24.0, folder / "b.mp4");
  REQUIRE(readBytes(folder / "a.mp4").size() > 200);
  REQUIRE(readBytes(folder / "a.mp4") == readBytes(folder / "b.mp4"));
}

TEST_CASE("video: a missing frame is named", "[render]") {
  const Scratch scratch;
  const fs::path folder = frames(scratch, "gap", 1, 3, 16, 16);
  fs::remove(folder / "0002.png");
  REQUIRE_THROWS_WITH(
      writeVideo(folder, 1, 3, 24.0, folder / "v.mp4"),
      Catch::Contains("v.mp4: the video could not be written: ") && Catch::Contains("0002.png is missing"));
  REQUIRE_THROWS_AS(writeVideo(folder, 2, 1, 24.0, folder / "v.mp4"), std::runtime_error);
  REQUIRE_THROWS_AS(writeVideo(folder, 1, 1, 0.0, folder / "v.mp4"), std::runtime_error);
}

TEST_CASE("video: what ffmpeg complains about is passed on in one line", "[render]") {
  const Scratch scratch;
  const fs::path folder = frames(scratch, "fails", 1, 1, 16, 16);
  try {
    writeVideo(folder, 1, 1, 24.0, "/nonexistent_folder/v.mp4");
    FAIL("nothing was thrown");
  } catch (const std::runtime_error& error) {
    const std::string what = error.what();
    CAPTURE(what);
    REQUIRE(what.find("/nonexistent_folder/v.mp4: the video could not be written: ffmpeg: ") == 0);
    REQUIRE(what.find("No such file or directory") != std::string::npos);
    REQUIRE(what.find('\n') == std::string::npos);
  }
  std::ofstream(folder / "0001.png") << "no picture";
  REQUIRE_THROWS_WITH(writeVideo(folder, 1, 1, 24.0, folder / "v.mp4"), Catch::Contains("ffmpeg: "));
}

TEST_CASE("video: a machine without ffmpeg is told so", "[render]") {
  const Scratch scratch;
  const fs::path folder = frames(scratch, "without", 1, 1, 16, 16);
  const std::string path = std::getenv("PATH");
  setenv("PATH", folder.c_str(), 1);
  std::string what;
  try {
    writeVideo(folder, 1, 1, 24.0, folder / "v.mp4");
  } catch (const std::runtime_error& error) {
    what = error.what();
  }
  setenv("PATH", path.c_str(), 1);
  REQUIRE(what.find("ffmpeg could not be started: No such file or directory") != std::string::npos);
}

TEST_CASE("video: one that the disk does not take to its last byte is a failure", "[render]") {
  const Scratch scratch;
  const fs::path folder = frames(scratch, "full", 1, 8, 64, 36);
  writeVideo(folder, 1, 8, 24.0, folder / "whole.mp4");
  const auto size = fs::file_size(folder / "whole.mp4");
  for (const std::uintmax_t limit : {std::uintmax_t{1}, size / 2, size - 1}) {
    std::string what;
    try {
      const FileLimit less(limit);
      writeVideo(folder, 1, 8, 24.0, folder / "cut.mp4");
    } catch (const std::runtime_error& error) {
      what = error.what();
    }
    CHECK_THAT(what, Catch::Contains("cut.mp4: the video could not be written: ffmpeg: "));
    CHECK(what.find('\n') == std::string::npos);
  }
}
