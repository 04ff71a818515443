#include "tools/frames/earlier_exports.h"

#include "tests/tools/frames/run_of_samples.h"
#include "tests/tools/program.h"
#include "tools/base/errors.h"

#include <catch2/catch.hpp>

namespace fs = std::filesystem;
using namespace fluidtex::tools;

namespace {

const std::atomic<bool> kGoOn{false};

// When each of the files was written last.
std::vector<fs::file_time_type> timesOf(const fs::path& out, const std::vector<std::string>& names) {
  std::vector<fs::file_time_type> times;
  for (const std::string& name : names) times.push_back(fs::last_write_time(out / name));
  return times;
}

}  // namespace

TEST_CASE(
    "formats: a resumed run makes those of earlier frames, with the bytes of one that made them at once",
    "[tools]") {
  const Scratch scratch;
  const fs::path whole = scratch.path / "whole", resumed = scratch.path / "resumed";
  const auto run = [&](const fs::path& out, const std::vector<std::string>& more) {
    const Finished done = runProgram(
        plus({"run", kSmallScene, "--no-render", "--no-report", "--quiet", "--out", out.string()}, more));
    INFO(done.all());
    REQUIRE(done.exitCode == 0);
  };
  run(whole, {"--frames", "1:3", "--format", "glb,usda,vtp"});
  run(resumed, {"--frames", "1:2"});
  run(resumed, {"--frames", "1:3", "--resume", "--format", "glb", "--format", "usda,vtp"});
  for (const char* name : {"glb/0001.glb", "glb/0003.glb", "usd/0002.usda", "vtp/0001.vtp", "small.pvd",
                           "small.usda", "exemplar.png"})
    CHECK(readBytes(whole / name) == readBytes(resumed / name));
  // What is lost or damaged is made again; what is whole stays.
  const auto time = fs::last_write_time(resumed / "glb" / "0002.glb");
  fs::resize_file(resumed / "vtp" / "0001.vtp", 100);
  fs::remove(resumed / "glb" / "0001.glb");
  run(resumed, {"--frames", "1:3", "--resume", "--format", "glb,usda,vtp"});
  CHECK(readBytes(whole / "vtp" / "0001.vtp") == readBytes(resumed / "vtp" / "0001.vtp"));
  CHECK(readBytes(whole / "glb" / "0001.glb") == readBytes(resumed / "glb" / "0001.glb"));
  CHECK(fs::last_write_time(resumed / "glb" / "0002.glb") == time);
  // With joints of the other kind all are made anew, so that a sequence is of one kind.
  const fs::path blended = scratch.path / "blended";
  run(blended, {"--frames", "1:3", "--format", "glb", "--joints", "blend"});
  run(resumed, {"--frames", "1:3", "--resume", "--format", "glb", "--joints", "blend"});
  for (const char* name : {"glb/0001.glb", "glb/0002.glb", "glb/0003.glb"}) {
    CHECK(readBytes(blended / name) == readBytes(resumed / name));
    CHECK(readBytes(blended / name) != readBytes(whole / name));
  }
  // A run that starts anew leaves nothing of them.
  run(resumed, {"--frames", "2"});
  CHECK_FALSE(fs::exists(resumed / "glb"));
  CHECK_FALSE(fs::exists(resumed / "vtp"));
  CHECK_FALSE(fs::exists(resumed / "small.usda"));
}

TEST_CASE("earlier exports: of the frames asked for, in the formats asked for, and none for PLY alone",
          "[tools]") {
  const Scratch scratch;
  makeRunOfSamples(scratch.path, 4);
  const std::vector<std::string> before = filesIn(scratch.path);
  exportEarlierFrames(scratch.path, 1, 4, sampleExports({}), sampleColor(), kGoOn);
  exportEarlierFrames(scratch.path, 3, 2, sampleExports({"glb"}), sampleColor(), kGoOn);
  CHECK(filesIn(scratch.path) == before);
  exportEarlierFrames(scratch.path, 2, 3, sampleExports({"glb"}), sampleColor(), kGoOn);
  std::vector<std::string> after = before;
  after.insert(after.begin(), {"glb/0002.glb", "glb/0003.glb"});
  CHECK(filesIn(scratch.path) == after);
}

TEST_CASE("earlier exports: a file that the journal does not have whole is made again, and only that",
          "[tools]") {
  const Scratch scratch;
  const Exports exports = sampleExports({"glb", "vtp"});
  makeRunOfSamples(scratch.path, 3);
  exportEarlierFrames(scratch.path, 1, 3, exports, sampleColor(), kGoOn);
  const std::vector<std::string> whole = {"glb/0001.glb", "glb/0003.glb", "vtp/0002.vtp", "vtp/0003.vtp"};
  const std::string glb = readBytes(scratch.path / "glb/0002.glb"),
                    vtp = readBytes(scratch.path / "vtp/0001.vtp");
  const auto times = timesOf(scratch.path, whole);
  fs::remove(scratch.path / "glb/0002.glb");
  std::ofstream(scratch.path / "vtp/0001.vtp", std::ios::app) << "x";
  exportEarlierFrames(scratch.path, 1, 3, exports, sampleColor(), kGoOn);
  CHECK((readBytes(scratch.path / "glb/0002.glb") == glb));
  CHECK(readBytes(scratch.path / "vtp/0001.vtp") == vtp);
  CHECK(timesOf(scratch.path, whole) == times);
}

TEST_CASE("earlier exports: a format that would come out otherwise is made anew in all frames", "[tools]") {
  const Scratch scratch;
  const fs::path out = scratch.path / "out", other = scratch.path / "other";
  const std::vector<std::string> glb = {"glb/0001.glb", "glb/0002.glb", "glb/0003.glb"},
                                 vtp = {"vtp/0001.vtp", "vtp/0002.vtp", "vtp/0003.vtp"};
  const auto bytesOf = [&](const fs::path& folder) {
    std::vector<std::string> bytes;
    for (const std::string& name : glb) bytes.push_back(readBytes(folder / name));
    return bytes;
  };
  Exports exports = sampleExports({"glb", "vtp"});
  makeRunOfSamples(out, 3);
  makeRunOfSamples(other, 3);
  exportEarlierFrames(out, 1, 3, exports, sampleColor(), kGoOn);
  const auto times = timesOf(out, vtp);
  const std::vector<std::string> before = bytesOf(out);
  exports.appearance.gloss = 0.5;  // which is in the material, and not in a VTP
  exportEarlierFrames(other, 1, 3, exports, sampleColor(), kGoOn);
  const std::vector<std::string> now = bytesOf(other);
  REQUIRE((now[2] != before[2]));
  // Interrupted after the first: the last is as it was, and so tells of it the next time.
  const std::atomic<bool> stop{true};
  CHECK_THROWS_AS(exportEarlierFrames(out, 1, 3, exports, sampleColor(), stop), Interrupted);
  CHECK((bytesOf(out) == std::vector<std::string>{now[0], before[1], before[2]}));
  exportEarlierFrames(out, 1, 3, exports, sampleColor(), kGoOn);
  CHECK((bytesOf(out) == now));
  CHECK(timesOf(out, vtp) == times);
  CHECK(filesIn(out / "state") == std::vector<std::string>{"journal.txt"});
}
