// fluidtex run --resume: after kills, interrupts and other wishes.
#include "tools/run_folder/earlier_frames.h"

#include "tests/tools/program.h"
#include "tests/tools/run_folder/inputs.h"
#include "tools/base/errors.h"
#include "tools/formats/read_ply.h"
#include "tools/run_folder/journal.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <csignal>
#include <fstream>

namespace fs = std::filesystem;
using namespace fluidtex::tools;

namespace {

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
    const Words words{"run", kSmallScene, "--no-render", "--out", to.string(), "--set",
                      std::string("frames=") + frames, "--exemplar", exemplars + "foam.png", "--set",
                      "texture.guidance.by=foam", "--set",
                      "texture.guidance.map=" + exemplars + "foam_guidance.png", "--set",
                      // So that what is carried counts, not what comes up.
                      "texture.guidance.foam={ from = 0.5, full = 1.0, lifetime = 30.0 }", "--set",
                      "texture.guidance.point=[{ value = 0.0, level = 0.0 }, { value = 1.0, level = 1.0 }]"};
    const Finished finished = runProgram(plus(words, more));
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
    const Finished run = runProgram(plus({"run", kSmallScene, "--resume", "--out", out}, more));
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

TEST_CASE("fluidtex run --resume: maps of vectors go on as they were", "[tools]") {
  const Scratch scratch;
  const fs::path whole = scratch.path / "whole", out = scratch.path / "out";
  writeImage(scratch.path / "bump.png", 64, 3);
  const Words run{"run",
                  kSmallScene,
                  "--set",
                  "texture.map=[{ name = 'bump', holds = 'normals', file = '" +
                      (scratch.path / "bump.png").string() + "' }]",
                  "--set",
                  "render.bump={ map = 'bump' }"};
  REQUIRE(runProgram(plus(run, {"--set", "frames=3", "--out", whole.string()})).exitCode == 0);
  REQUIRE(runProgram(plus(run, {"--set", "frames=2", "--out", out.string()})).exitCode == 0);
  // The last frame's files are made from the state, vectors and all.
  fs::remove(out / "frames" / "0002.png");
  std::ofstream(out / "surface" / "0002.ply", std::ios::app) << "x";
  const Finished resumed = runProgram(plus(run, {"--set", "frames=3", "--out", out.string(), "--resume"}));
  INFO(resumed.all());
  REQUIRE(resumed.exitCode == 0);
  CHECK(namesOf(resultsIn(out)) == namesOf(resultsIn(whole)));
  CHECK(differing(resultsIn(out), resultsIn(whole)).empty());
  CHECK((readBytes(out / "small.mp4") == readBytes(whole / "small.mp4")));
}

TEST_CASE("fluidtex run --resume: results that were damaged since are seen", "[tools]") {
  const Scratch scratch;
  const fs::path out = scratch.path / "out";
  const Words run{"run", kSmallScene, "--out", out.string(), "--set"},
      more = plus(run, {"frames=3", "--resume"});
  REQUIRE(runProgram(plus(run, {"frames=2"})).exitCode == 0);
  const auto refused = [&](const char* name, const std::string& bytes, const std::string& words) {
    const std::string whole = readBytes(out / name);
    if (bytes.empty())
      fs::remove(out / name);
    else
      std::ofstream(out / name, std::ios::binary) << bytes;
    const Finished resumed = runProgram(more);
    CHECK(resumed.exitCode == 1);
    CHECK_THAT(resumed.err, Catch::Contains("frames 1 to 2 are done, but " + std::string(name) + words));
    std::ofstream(out / name, std::ios::binary) << whole;
  };
  const std::string picture = readBytes(out / "frames" / "0001.png");
  refused("frames/0001.png", picture.substr(0, picture.size() / 2), " is not as the run wrote it");
  refused("surface/0001.ply", "x", " is not as the run wrote it");
  refused("surface/0001.ply", "", " is not there");

  // What is known of the frames before is lost.
  const std::string journal = readBytes(out / "state" / "journal.txt");
  std::ofstream(out / "state" / "journal.txt") << journal.substr(journal.find("{\"frame\":2"));
  const Finished lost = runProgram(more);
  CHECK(lost.exitCode != 0);
  std::ofstream(out / "state" / "journal.txt") << journal;

  // What fluidtex apply writes is as good.
  writeImage(scratch.path / "height.png", 64, 1);
  REQUIRE(runProgram({"apply", out.string(), "height=" + (scratch.path / "height.png").string()}).exitCode ==
          0);
  const Finished resumed = runProgram(more);
  INFO(resumed.all());
  CHECK(resumed.exitCode == 0);
}

TEST_CASE("earlier frames: where there is nothing to resume, what a killed run has left is cleared",
          "[tools]") {
  const Scratch scratch;
  fs::create_directories(scratch.path / "surface");
  fs::create_directories(scratch.path / "state" / ".tmp-0004");
  std::ofstream(scratch.path / "surface" / ".tmp-0004.ply") << "half";
  std::ofstream(scratch.path / "surface" / "0003.ply") << "whole";
  RunOptions options;
  options.out = scratch.path;
  CHECK_FALSE(earlierFrames({}, options, {}, 5));
  CHECK(filesIn(scratch.path) == Words{"surface/0003.ply"});
  CHECK_FALSE(fs::exists(scratch.path / "state" / ".tmp-0004"));
}

TEST_CASE("earlier frames: all that are done are taken over, the last again where its files are lost",
          "[tools]") {
  const Scratch scratch;
  const fs::path out = scratch.path / "out", journal = out / "state" / "journal.txt";
  REQUIRE(runProgram({"run", kSmallScene, "--no-render", "--no-report", "--frames", "1:2", "--quiet", "--out",
                      out.string()})
              .exitCode == 0);
  const fluidtex::scenes::Scene scene = fluidtex::scenes::loadScene(kSmallScene);
  RunOptions options;
  options.out = out;
  options.render = false;
  Report now = parseReport(readBytes(out / "run.json"));
  std::vector<Json> records = std::move(now.frames);
  REQUIRE(records.size() == 2);
  now.frames.clear();
  const auto written = readPly(out / "surface" / "0002.ply", 256, 256);
  const auto found = [&] {
    std::optional<EarlierFrames> earlier = earlierFrames(scene, options, now, 5);
    REQUIRE(earlier);
    CHECK(earlier->solver.frame == 2);
    CHECK(earlier->records == records);
    CHECK(earlier->surface.positions == written.positions);
    CHECK(earlier->surface.triangles == written.triangles);
    return earlier->writeLastAgain;
  };
  CHECK_FALSE(found());

  // A kill right behind the state: the journal gets the record of the last frame back, as it is there.
  records[1] = parseReport(readBytes(out / "state" / "0002" / "run.json")).frames.back();
  const std::string lines = readBytes(journal);
  std::ofstream(journal) << lines.substr(0, lines.rfind("{\"frame\":2", lines.size()));
  CHECK_FALSE(found());
  CHECK(readJournal(out).frames.at(2) == records[1]);

  const std::string last = readBytes(out / "surface" / "0002.ply"),
                    first = readBytes(out / "surface" / "0001.ply");
  std::ofstream(out / "surface" / "0002.ply", std::ios::app) << "x";
  CHECK(found());
  std::ofstream(out / "surface" / "0002.ply", std::ios::binary) << last;
  std::ofstream(out / "surface" / "0001.ply") << "x";
  CHECK_THROWS_AS(earlierFrames(scene, options, now, 5), UsageError);
  CHECK_THROWS_WITH(earlierFrames(scene, options, now, 5),
                    Catch::Contains("surface/0001.ply is not as the run wrote it"));
  options.firstFrame = 2;  // then nobody asks for it
  CHECK_FALSE(found());
  options.firstFrame = 1;
  std::ofstream(out / "surface" / "0001.ply", std::ios::binary) << first;

  Report other = now;
  other.scene["seed"] = 8;
  CHECK_THROWS_AS(earlierFrames(scene, options, other, 5), UsageError);
  CHECK_THROWS_WITH(
      earlierFrames(scene, options, other, 5),
      Catch::Contains("seed was 7 and is 8") && Catch::Contains("run without --resume to start anew"));
  fs::resize_file(out / "state" / "0002" / "surface.bin", 100);
  CHECK_THROWS_AS(earlierFrames(scene, options, now, 5), std::runtime_error);
}
