// The program as a whole, on the smallest scene that passes every stage.
#include "tests/tools/program.h"

#include "tests/tools/scratch.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <chrono>
#include <csignal>
#include <thread>

namespace fs = std::filesystem;

namespace {

const std::string kScene = FLUIDTEX_SOURCE "/tests/tools/small.toml";

// frames/ and surface/ as name -> bytes: what must not depend on threads, kills or the clock.
std::vector<std::pair<std::string, std::string>> results(const fs::path& out) {
  std::vector<std::pair<std::string, std::string>> files;
  for (const char* folder : {"frames", "surface"})
    if (fs::exists(out / folder))
      for (const std::string& name : filesIn(out / folder))
        files.emplace_back(folder + ("/" + name), readBytes(out / folder / name));
  return files;
}

std::vector<std::string> names(const std::vector<std::pair<std::string, std::string>>& files) {
  std::vector<std::string> result;
  for (const auto& file : files) result.push_back(file.first);
  return result;
}

}  // namespace

TEST_CASE("fluidtex run: writes every file of a run, and run.json with every frame", "[tools]") {
  const Scratch scratch;
  const fs::path out = scratch.path / "out";
  const Finished run = runProgram({"run", kScene, "--out", out.string()});
  INFO(run.output);
  REQUIRE(run.exitCode == 0);
  CHECK_THAT(run.output, Catch::Contains("frame 5/5"));
  CHECK(filesIn(out) ==
        std::vector<std::string>{"frames/0001.png", "frames/0002.png", "frames/0003.png", "frames/0004.png",
                                 "frames/0005.png", "log.txt", "run.json", "small.mp4",
                                 "state/0005/manifest.txt", "state/0005/run.json", "state/0005/solver.vdb",
                                 "state/0005/surface.bin", "surface/0001.ply", "surface/0002.ply",
                                 "surface/0003.ply", "surface/0004.ply", "surface/0005.ply"});
  const auto json = nlohmann::json::parse(readBytes(out / "run.json"));
  REQUIRE(json.at("frames").size() == 5);
  const auto& first = json.at("frames").front();
  const auto& last = json.at("frames").back();
  CHECK(first.at("substeps") == 0);
  CHECK(last.at("substeps").get<int>() >= 1);
  CHECK(last.at("time").get<double>() == Approx(4.0 / 24));
  CHECK(first.at("vertices").get<double>() == Approx(3000).epsilon(0.05));
  // A tank part filled, and a ball: 0.4 x 0.625 x 0.3 + 4/3 pi 0.15^3 cubic metres.
  CHECK(first.at("volume").get<double>() == Approx(0.075 + 0.01414).epsilon(0.05));
  CHECK(last.at("volume").get<double>() == Approx(first.at("volume").get<double>()).epsilon(0.1));
  CHECK(last.at("renewed").get<double>() < 0.9);
  CHECK(json.at("scene").at("seed") == 7);
}

TEST_CASE("fluidtex run: the same bytes on one thread as on two", "[tools]") {
  const Scratch scratch;
  for (const char* threads : {"1", "2"}) {
    const Finished run = runProgram(
        {"run", kScene, "--frames", "1:3", "--threads", threads, "--out", (scratch.path / threads).string()});
    INFO(run.output);
    REQUIRE(run.exitCode == 0);
  }
  const auto one = results(scratch.path / "1"), two = results(scratch.path / "2");
  REQUIRE(names(one).size() == 6);
  REQUIRE(names(one) == names(two));
  for (std::size_t i = 0; i < one.size(); ++i) {
    INFO(one[i].first);
    CHECK((one[i].second == two[i].second));
  }
}

TEST_CASE("fluidtex run --resume: killed at any moment, it ends with the bytes of an unbroken run",
          "[tools][slow]") {
  const Scratch scratch;
  const fs::path whole = scratch.path / "whole", broken = scratch.path / "broken",
                 output = scratch.path / "output";
  REQUIRE(runProgram({"run", kScene, "--out", whole.string()}).exitCode == 0);
  const auto expected = results(whole);
  int kills = 0;
  for (auto delay = std::chrono::milliseconds(150);; delay = delay + delay / 4) {
    const pid_t child = startProgram({"run", kScene, "--out", broken.string(), "--resume"}, output);
    std::this_thread::sleep_for(delay);
    kill(child, SIGKILL);
    const Finished run = waitFor(child, output);
    // Whatever bears a final name is whole.
    for (const auto& file : results(broken)) {
      if (file.first.find("/.tmp-") != std::string::npos) continue;
      INFO(file.first);
      const auto same = std::find_if(expected.begin(), expected.end(),
                                     [&](const auto& e) { return e.first == file.first; });
      REQUIRE(same != expected.end());
      REQUIRE((same->second == file.second));
    }
    if (run.exitCode >= 0) {
      INFO(run.output);
      REQUIRE(run.exitCode == 0);
      break;
    }
    ++kills;
  }
  CHECK(kills >= 3);
  const auto resumed = results(broken);
  REQUIRE(names(resumed) == names(expected));
  CHECK((readBytes(broken / "small.mp4") == readBytes(whole / "small.mp4")));
}

TEST_CASE("fluidtex run --resume: other settings are refused, and nothing is lost", "[tools]") {
  const Scratch scratch;
  const std::string out = (scratch.path / "out").string();
  REQUIRE(runProgram({"run", kScene, "--frames", "1:1", "--out", out}).exitCode == 0);
  const auto before = results(out);
  const Finished run = runProgram({"run", kScene, "--resume", "--set", "texture.points=2000", "--out", out});
  CHECK(run.exitCode == 1);
  CHECK_THAT(run.output, Catch::Contains("texture.points was 3000 and is 2000"));
  CHECK((results(out) == before));
}

TEST_CASE("fluidtex: wrong input exits with 1 and a sentence", "[tools]") {
  const Scratch scratch;
  const std::string out = (scratch.path / "out").string();
  const auto refused = [](const std::vector<std::string>& args, const std::string& words) {
    const Finished run = runProgram(args);
    CHECK(run.exitCode == 1);
    CHECK_THAT(run.output, Catch::Contains(words));
  };
  refused({"run", "no_such_scene.toml", "--out", out}, "no_such_scene.toml");
  refused({"run", kScene, "--set", "texture.windwos=[9]", "--out", out}, "did you mean texture.windows?");
  refused({"run", kScene, "--frames", "3:1", "--out", out}, "ends before it begins");
  refused({"run", kScene, "--frames", "1:99", "--out", out}, "the scene has 5 frames");
  refused({"run", kScene, "--frames", "x", "--out", out}, "is no range of frames");
  refused({"run", kScene, "--exemplar", kScene, "--out", out}, "small.toml");
  refused({"walk"}, "walk: no such command");
  CHECK_FALSE(fs::exists(fs::path(out) / "frames"));
}

TEST_CASE("fluidtex: version, help with an example for each subcommand, and the plan of a scene", "[tools]") {
  CHECK_THAT(runProgram({"--version"}).output, Catch::StartsWith("fluidtex "));
  for (const char* command : {"run", "check"}) {
    const Finished help = runProgram({command, "--help"});
    CHECK(help.exitCode == 0);
    CHECK_THAT(help.output, Catch::Contains("Example:") && Catch::Contains("--quality"));
  }
  const Finished plan = runProgram({"check", kScene});
  INFO(plan.output);
  CHECK(plan.exitCode == 0);
  CHECK_THAT(plan.output,
             Catch::Contains("24 x 15 x 15 cells") && Catch::Contains("3000 on the first surface"));
}

TEST_CASE("fluidtex: a viscosity that is not simulated is named, and nothing else about a valid scene",
          "[tools]") {
  CHECK_THAT(runProgram({"check", kScene}).output, !Catch::Contains("warning"));
  const Finished thick = runProgram({"check", kScene, "--set", "fluid.viscosity=50"});
  CHECK(thick.exitCode == 0);
  CHECK_THAT(thick.output,
             Catch::Contains("small.toml: warning: fluid.viscosity: 50 Pa s is not simulated yet"));
}
