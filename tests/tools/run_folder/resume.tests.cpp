// fluidtex run --resume: after kills, interrupts and other wishes.
#include "tests/tools/program.h"
#include "tools/output/ply.h"
#include "tools/output/read_ply.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <csignal>
#include <fstream>

namespace fs = std::filesystem;

namespace {

using Words = std::vector<std::string>;

// The frames that run.json tells of.
std::vector<int> reported(const fs::path& out) {
  std::vector<int> frames;
  const auto json = nlohmann::json::parse(readBytes(out / "run.json"));
  for (const auto& frame : json.at("frames")) frames.push_back(frame.at("frame").get<int>());
  return frames;
}

std::vector<int> upTo(int last) {
  std::vector<int> frames;
  for (int frame = 1; frame <= last; ++frame) frames.push_back(frame);
  return frames;
}

}  // namespace

TEST_CASE("fluidtex run --resume: killed at any moment, it ends with the bytes of an unbroken run",
          "[tools][slow]") {
  const Scratch scratch;
  const fs::path whole = scratch.path / "whole", broken = scratch.path / "broken", log = broken / "log.txt";
  REQUIRE(runProgram({"run", kSmallScene, "--out", whole.string()}).exitCode == 0);
  const Results expected = resultsIn(whole);
  // Each run is killed so many milliseconds after it has written so many lines to its log: one as it starts,
  // one for each frame that is done.
  const std::vector<std::pair<int, int>> moments = {{0, 20}, {1, 0},  {1, 200}, {2, 0}, {2, 5}, {1, 10},
                                                    {1, 25}, {1, 40}, {1, 55},  {2, 1}, {1, 3}, {1, 70}};
  int kills = 0;
  for (const auto& [lines, delay] : moments) {
    const long before = RunningProgram::countLines(log);
    const RunningProgram program({"run", kSmallScene, "--out", broken.string(), "--resume"});
    program.waitForLines(log, before, lines);
    std::this_thread::sleep_for(std::chrono::milliseconds(delay));
    program.signal(SIGKILL);
    kills += program.wait().exitCode < 0;
    // Whatever bears a final name is whole.
    for (const std::string& name : differing(resultsIn(broken), expected)) {
      INFO(name);
      CHECK(name.find("/.tmp-") != std::string::npos);
    }
    if (fs::exists(broken / "run.json")) {
      const std::vector<int> frames = reported(broken);
      CHECK(frames == upTo(static_cast<int>(frames.size())));
    }
  }
  // The first three fall long before the run can have ended, on any machine.
  CHECK(kills >= 3);
  const Finished last = runProgram({"run", kSmallScene, "--out", broken.string(), "--resume"});
  INFO(last.all());
  REQUIRE(last.exitCode == 0);
  const Results resumed = resultsIn(broken);
  CHECK(namesOf(resumed) == namesOf(expected));
  CHECK(differing(resumed, expected).empty());
  CHECK((readBytes(broken / "small.mp4") == readBytes(whole / "small.mp4")));
  CHECK(reported(broken) == upTo(5));
}

TEST_CASE("fluidtex run --resume: interrupted, it exits with 130 and goes on to the same bytes", "[tools]") {
  const Scratch scratch;
  const fs::path whole = scratch.path / "whole", broken = scratch.path / "broken";
  REQUIRE(runProgram({"run", kSmallScene, "--frames", "1:3", "--out", whole.string()}).exitCode == 0);
  // Many more frames than can be done before the signal comes; the camera does not turn, so that it may have
  // fewer afterwards.
  const RunningProgram program({"run", kSmallScene, "--set", "frames=500", "--out", broken.string()});
  program.waitForLines(broken / "log.txt", 0, 3);
  program.signal(SIGINT);
  const Finished interrupted = program.wait();
  CHECK(interrupted.exitCode == 130);
  CHECK_THAT(interrupted.err, Catch::Contains("--resume goes on from the last finished frame"));
  const Finished resumed =
      runProgram({"run", kSmallScene, "--resume", "--frames", "1:3", "--out", broken.string()});
  INFO(resumed.all());
  REQUIRE(resumed.exitCode == 0);
  CHECK(differing(resultsIn(whole), resultsIn(broken)).empty());
  CHECK((readBytes(broken / "small.mp4") == readBytes(whole / "small.mp4")));
}

TEST_CASE("fluidtex run: interrupted while the video is written, it exits with 130", "[tools]") {
  const Scratch scratch;
  // Ctrl-C reaches the program and its encoder alike.
  const fs::path encoder = scratch.path / "bin" / "ffmpeg";
  fs::create_directories(encoder.parent_path());
  std::ofstream(encoder) << "#!/bin/sh\nkill -INT $PPID\nexit 255\n";
  fs::permissions(encoder, fs::perms::owner_all);
  const Words args = {"run", kSmallScene, "--frames", "1:1", "--out", (scratch.path / "out").string()};
  const Finished run = RunningProgram(args, {}, encoder.parent_path()).wait();
  INFO(run.all());
  CHECK(run.exitCode == 130);
  CHECK_FALSE(fs::exists(scratch.path / "out" / "small.mp4"));
  Words again = args;
  again.emplace_back("--resume");
  CHECK(runProgram(again).exitCode == 0);
  CHECK(fs::exists(scratch.path / "out" / "small.mp4"));
}

TEST_CASE("fluidtex run --resume: with more frames it goes on as if they had always been asked for",
          "[tools]") {
  const Scratch scratch;
  const fs::path whole = scratch.path / "whole", out = scratch.path / "out";
  REQUIRE(runProgram({"run", kSmallScene, "--set", "frames=3", "--out", whole.string()}).exitCode == 0);
  REQUIRE(runProgram({"run", kSmallScene, "--set", "frames=2", "--out", out.string()}).exitCode == 0);
  // Killed between the state and run.json.
  fs::remove(out / "run.json");
  const Finished run =
      runProgram({"run", kSmallScene, "--set", "frames=3", "--resume", "--out", out.string()});
  INFO(run.all());
  REQUIRE(run.exitCode == 0);
  CHECK_THAT(run.err, !Catch::Contains("frame 2/"));
  CHECK(namesOf(resultsIn(out)).size() == 6);
  CHECK(differing(resultsIn(out), resultsIn(whole)).empty());
  CHECK(reported(out) == upTo(3));
  CHECK(nlohmann::json::parse(readBytes(out / "run.json")).at("scene").at("frames") == 3);

  // Nothing is left to do but run.json.
  fs::remove(out / "run.json");
  CHECK(runProgram({"run", kSmallScene, "--set", "frames=3", "--resume", "--out", out.string()}).exitCode ==
        0);
  CHECK(reported(out) == upTo(3));
}

TEST_CASE("fluidtex run --resume: foam goes on as it was", "[tools]") {
  const Scratch scratch;
  const fs::path whole = scratch.path / "whole", out = scratch.path / "out";
  const std::string exemplars = FLUIDTEX_SOURCE "/scenes/exemplars/";
  const auto run = [&](const char* frames, const fs::path& to, const Words& more) {
    Words words{"run", kSmallScene, "--no-render", "--out", to.string(), "--set",
                std::string("frames=") + frames, "--exemplar", exemplars + "foam.png", "--set",
                "texture.guidance.by=foam", "--set",
                "texture.guidance.map=" + exemplars + "foam_guidance.png", "--set",
                // So that what is carried counts, not what comes up.
                "texture.guidance.foam={ from = 0.5, full = 1.0, lifetime = 30.0 }", "--set",
                "texture.guidance.point=[{ value = 0.0, level = 0.0 }, { value = 1.0, level = 1.0 }]"};
    words.insert(words.end(), more.begin(), more.end());
    const Finished finished = runProgram(words);
    INFO(finished.all());
    REQUIRE(finished.exitCode == 0);
  };
  run("4", whole, {});
  run("3", out, {});
  run("4", out, {"--resume"});
  CHECK(differing(resultsIn(out), resultsIn(whole)).empty());
  const auto last = fluidtex::tools::readPly(whole / "surface" / "0004.ply", 384, 384);
  const std::vector<float>& foam = last.foam;
  CHECK(*std::max_element(foam.begin(), foam.end()) > 0.5f);
}

TEST_CASE("fluidtex run --resume: what cannot be finished is refused at once, and nothing is lost",
          "[tools]") {
  const Scratch scratch;
  const std::string out = (scratch.path / "out").string();
  REQUIRE(runProgram({"run", kSmallScene, "--no-render", "--frames", "2:2", "--out", out}).exitCode == 0);
  const auto files = filesIn(out);
  const auto refused = [&](const Words& more, const std::string& words) {
    Words args = {"run", kSmallScene, "--resume", "--out", out};
    args.insert(args.end(), more.begin(), more.end());
    const Finished run = runProgram(args);
    CHECK(run.exitCode == 1);
    CHECK_THAT(run.err, Catch::Contains(words) && Catch::Contains("without --resume"));
    CHECK(filesIn(out) == files);
  };
  refused({"--set", "texture.points=2000"}, "texture.points was 3000 and is 2000");
  refused({"--frames", "2:3"}, "frames 1 to 2 are done, but frames/0002.png is not there");
  refused({"--no-render"}, "frames 1 to 2 are done, but surface/0001.ply is not there");
  CHECK(runProgram({"run", kSmallScene, "--resume", "--frames", "3:3", "--out", out}).exitCode == 0);
}

TEST_CASE("fluidtex run --resume: goes on from wherever the scene is named", "[tools]") {
  const Scratch scratch;
  const std::string out = (scratch.path / "out").string();
  const Words rest = {"--frames", "1:1", "--no-render", "--out", out};
  Words near = {"run", "tests/tools/small.toml"}, far = {"run", kSmallScene, "--resume"};
  near.insert(near.end(), rest.begin(), rest.end());
  far.insert(far.end(), rest.begin(), rest.end());
  REQUIRE(runProgram(near, FLUIDTEX_SOURCE).exitCode == 0);
  const Finished run = runProgram(far, scratch.path);
  INFO(run.all());
  CHECK(run.exitCode == 0);
}

TEST_CASE("fluidtex run --resume: without a state it starts anew and leaves nothing stale", "[tools]") {
  const Scratch scratch;
  const fs::path out = scratch.path / "out";
  fs::create_directories(out / "frames");
  fs::create_directories(out / "state" / ".tmp-0004");
  std::ofstream(out / "frames" / "0004.png") << "stale";
  REQUIRE(runProgram({"run", kSmallScene, "--resume", "--frames", "1:1", "--out", out.string()}).exitCode ==
          0);
  CHECK(namesOf(resultsIn(out)) == Words{"frames/0001.png", "surface/0001.ply"});
  CHECK_FALSE(fs::exists(out / "state" / ".tmp-0004"));
}
