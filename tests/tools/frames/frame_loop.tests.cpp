// The frames of a run, through the whole program.
#include "tools/frames/frame_loop.h"

#include "tests/tools/program.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>

namespace fs = std::filesystem;

TEST_CASE("fluidtex run: writes every file of a run, and run.json with every frame", "[tools]") {
  const Scratch scratch;
  const fs::path out = scratch.path / "out";
  const Finished run = runProgram({"run", kSmallScene, "--out", out.string()});
  INFO(run.all());
  REQUIRE(run.exitCode == 0);
  CHECK(run.out.empty());
  CHECK_THAT(run.err, Catch::Contains("frame 5/5"));
  CHECK(filesIn(out) == std::vector<std::string>{"exemplar.png",
                                                 "frames/0001.png",
                                                 "frames/0002.png",
                                                 "frames/0003.png",
                                                 "frames/0004.png",
                                                 "frames/0005.png",
                                                 "log.txt",
                                                 "report.html",
                                                 "run.json",
                                                 "small.mp4",
                                                 "state/0005/manifest.txt",
                                                 "state/0005/run.json",
                                                 "state/0005/solver.vdb",
                                                 "state/0005/surface.bin",
                                                 "state/journal.txt",
                                                 "surface/0001.ply",
                                                 "surface/0002.ply",
                                                 "surface/0003.ply",
                                                 "surface/0004.ply",
                                                 "surface/0005.ply"});
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
  // The record of the state lacks the time that the state itself took.
  const auto saved = nlohmann::json::parse(readBytes(out / "state" / "0005" / "run.json"));
  CHECK(last.at("seconds").at("write").get<double>() >
        saved.at("frames").back().at("seconds").at("write").get<double>());
}

TEST_CASE("fluidtex run: the same bytes on one thread as on two", "[tools]") {
  const Scratch scratch;
  for (const char* threads : {"1", "2"}) {
    const Finished run = runProgram({"run", kSmallScene, "--frames", "1:3", "--threads", threads, "--out",
                                     (scratch.path / threads).string()});
    INFO(run.all());
    REQUIRE(run.exitCode == 0);
  }
  const Results one = resultsIn(scratch.path / "1"), two = resultsIn(scratch.path / "2");
  REQUIRE(namesOf(one).size() == 6);
  REQUIRE(namesOf(one) == namesOf(two));
  CHECK(differing(one, two).empty());
}

TEST_CASE("fluidtex run --frames: earlier frames are computed and not written", "[tools]") {
  const Scratch scratch;
  const fs::path whole = scratch.path / "whole", part = scratch.path / "part";
  REQUIRE(runProgram({"run", kSmallScene, "--frames", "1:3", "--out", whole.string()}).exitCode == 0);
  REQUIRE(runProgram({"run", kSmallScene, "--frames", "2:3", "--out", part.string()}).exitCode == 0);
  const Results results = resultsIn(part);
  CHECK(namesOf(results) == std::vector<std::string>{"frames/0002.png", "frames/0003.png", "surface/0002.ply",
                                                     "surface/0003.ply"});
  CHECK(differing(results, resultsIn(whole)).empty());
  CHECK(fs::exists(part / "small.mp4"));
}

TEST_CASE("fluidtex: wrong input is refused before anything of an earlier run is lost", "[tools]") {
  const Scratch scratch;
  const fs::path out = scratch.path / "out", rock = scratch.path / "rock.obj";
  REQUIRE(runProgram({"run", kSmallScene, "--frames", "1:1", "--out", out.string()}).exitCode == 0);
  std::ofstream(rock) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const auto before = filesIn(out);
  const std::string log = readBytes(out / "log.txt");
  const std::string mesh = "solid=[{mesh={file='" + rock.string() + "'}}]";
  for (const std::vector<std::string>& args :
       {std::vector<std::string>{"run", kSmallScene, "--set", mesh, "--out", out.string()},
        {"run", kSmallScene, "--set", "liquid.0.mesh={file='" + rock.string() + "'}", "--out", out.string()},
        {"check", kSmallScene, "--quiet", "--set", mesh}}) {
    const Finished run = runProgram(args);
    CHECK(run.exitCode == 1);
    CHECK_THAT(run.err, Catch::Contains("rock.obj: is not closed"));
  }
  CHECK(runProgram({"run", kSmallScene, "--exemplar", rock.string(), "--out", out.string()}).exitCode == 1);
  CHECK(filesIn(out) == before);
  CHECK_THAT(readBytes(out / "log.txt"), Catch::StartsWith(log));
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

namespace {

const std::string kRipples = FLUIDTEX_SOURCE "/scenes/exemplars/ripples/%04d.png";

std::vector<std::string> movingRun(const fs::path& out, const Words& more = {}) {
  return plus({"run", kSmallScene, "--exemplar", kRipples, "--set", "texture.toroidal=true", "--set",
               "texture.animation.rate=18", "--frames", "1:3", "--out", out.string()},
              more);
}

}  // namespace

TEST_CASE("fluidtex run: an exemplar that moves, in its own picture a frame, resumed to the same bytes",
          "[tools]") {
  const Scratch scratch;
  const fs::path whole = scratch.path / "whole", parts = scratch.path / "parts";
  Finished run =
      runProgram(movingRun(whole, {"--format", "glb,usda,obj", "--set", "texture.between=exemplar"}));
  INFO(run.all());
  REQUIRE(run.exitCode == 0);
  for (const char* frame : {"0001", "0002", "0003"}) {
    CHECK(fs::exists(whole / "exemplar" / (std::string(frame) + ".png")));
    CHECK_THAT(readBytes(whole / "usd" / (std::string(frame) + ".usda")),
               Catch::Contains("timeSamples = { " + std::to_string(std::stoi(frame)) + ": @../exemplar/" +
                               std::string(frame) + ".png@ }"));
    CHECK_THAT(readBytes(whole / "glb" / (std::string(frame) + ".glb")),
               Catch::Contains("../exemplar/" + std::string(frame) + ".png"));
    CHECK_THAT(readBytes(whole / "obj" / (std::string(frame) + ".obj")),
               Catch::Contains("mtllib " + std::string(frame) + ".mtl"));
    CHECK_THAT(readBytes(whole / "obj" / (std::string(frame) + ".mtl")),
               Catch::Contains("map_Kd ../exemplar/" + std::string(frame) + ".png"));
  }
  CHECK(readBytes(whole / "exemplar" / "0001.png") != readBytes(whole / "exemplar" / "0002.png"));

  const Words first{"--format", "glb,usda,obj", "--set", "texture.between=exemplar"};
  Words begun = movingRun(parts, first);
  std::replace(begun.begin(), begun.end(), std::string("1:3"), std::string("1:1"));
  REQUIRE(runProgram(begun).exitCode == 0);
  Words resumed = movingRun(parts, first);
  resumed.push_back("--resume");
  run = runProgram(resumed);
  INFO(run.all());
  REQUIRE(run.exitCode == 0);
  for (const char* folder : {"exemplar", "frames", "glb", "obj", "surface", "usd"})
    for (const auto& entry : fs::directory_iterator(whole / folder))
      CHECK(readBytes(entry.path()) == readBytes(parts / folder / entry.path().filename()));

  // Drawn again it shows the same pictures.
  const fs::path again = scratch.path / "again";
  run = runProgram({"render", kSmallScene, "--exemplar", kRipples, "--set", "texture.toroidal=true", "--set",
                    "texture.animation.rate=18", "--set", "texture.between=exemplar", "--from",
                    whole.string(), "--out", again.string(), "--frames", "2:2"});
  INFO(run.all());
  REQUIRE(run.exitCode == 0);
  CHECK(readBytes(again / "frames" / "0002.png") == readBytes(whole / "frames" / "0002.png"));

  // What moves in the exemplar is no change of the texture.
  REQUIRE(runProgram({"measure", whole.string(), "--json", (scratch.path / "m.json").string()}).exitCode ==
          0);
  const auto measured = nlohmann::json::parse(readBytes(scratch.path / "m.json"));
  CHECK(measured.at("mean").at("change").get<double>() < 0.05);
}

TEST_CASE("fluidtex run: guidance chooses pictures of an exemplar, place by place", "[tools]") {
  const Scratch scratch;
  const fs::path out = scratch.path / "out";
  const Finished run =
      runProgram({"run", kSmallScene, "--set",
                  "texture.exemplar=" FLUIDTEX_SOURCE "/scenes/exemplars/lava_stages/%04d.png", "--set",
                  "texture.animation.by=guidance", "--set", "texture.guidance.by=height", "--set",
                  "texture.guidance.point=[{ value = 0.0, level = 0.0 }, { value = 0.4, level = 1.0 }]",
                  "--frames", "1:2", "--no-render", "--format", "glb", "--out", out.string()});
  INFO(run.all());
  REQUIRE(run.exitCode == 0);
  CHECK_FALSE(fs::exists(out / "exemplar"));
  // No picture has the colours of all places.
  CHECK_THAT(readBytes(out / "glb" / "0002.glb"), !Catch::Contains(".png"));
}
