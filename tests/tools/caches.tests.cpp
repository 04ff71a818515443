// fluidtex simulate, texture and check: a liquid out of files.
#include "tests/tools/balls.h"
#include "tools/formats/read_ply.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <thread>

namespace fs = std::filesystem;
using Json = nlohmann::json;
using namespace fluidtex;

TEST_CASE(
    "caches: texture from simulated files is the run's own, also where both went on from an earlier frame",
    "[tools]") {
  const Scratch scratch;
  const fs::path cache = scratch.path / "cache", whole = scratch.path / "whole", from = scratch.path / "from";
  REQUIRE(runProgram({"run", kSmallScene, "--out", whole.string(), "--quiet"}).exitCode == 0);
  REQUIRE(runProgram({"simulate", kSmallScene, "--cache", cache.string(), "--frames", "1:2", "--quiet"})
              .exitCode == 0);
  REQUIRE(runProgram({"simulate", kSmallScene, "--cache", cache.string(), "--resume", "--quiet"}).exitCode ==
          0);
  std::vector<std::string> run{"run",
                               kSmallScene,
                               "--out",
                               from.string(),
                               "--quiet",
                               "--set",
                               "motion.flow=files",
                               "--set",
                               "files.path=" + cache.string()};
  std::vector<std::string> part = run;
  part.insert(part.end(), {"--frames", "1:3"});
  REQUIRE(runProgram(part).exitCode == 0);
  run.push_back("--resume");
  REQUIRE(runProgram(run).exitCode == 0);
  for (int frame = 1; frame <= 5; ++frame) {
    const std::string name = "000" + std::to_string(frame);
    CHECK(readBytes(from / "surface" / (name + ".ply")) == readBytes(whole / "surface" / (name + ".ply")));
    CHECK(readBytes(from / "frames" / (name + ".png")) == readBytes(whole / "frames" / (name + ".png")));
  }
}

TEST_CASE("caches: a folder of meshes with velocities is textured without a scene", "[tools]") {
  const Scratch scratch;
  const fs::path cache = scratch.path / "balls", out = scratch.path / "out", again = scratch.path / "again";
  fs::create_directory(cache);
  writeBalls(cache, 4, 1.2, 1.2);
  const Finished done = textured(cache, out);
  CHECK(done.out.find("attribute v") != std::string::npos);
  const Json report = Json::parse(readBytes(out / "run.json"));
  REQUIRE(report["frames"].size() == 4);
  CHECK(report["frames"][1]["explained"].get<double>() > 0.99);
  CHECK(report["frames"][3]["renewed"].get<double>() < 0.05);

  std::vector<std::string> part = texturing(cache, again), rest = part;
  part.insert(part.end(), {"--frames", "1:2"});
  rest.push_back("--resume");
  REQUIRE(runProgram(part).exitCode == 0);
  REQUIRE(runProgram(rest).exitCode == 0);
  CHECK(readBytes(again / "surface/0004.ply") == readBytes(out / "surface/0004.ply"));
}

TEST_CASE("caches: an attribute guides, scales and turns the texture by its own name", "[tools]") {
  const Scratch scratch;
  const fs::path cache = scratch.path / "balls", out = scratch.path / "out";
  fs::create_directory(cache);
  writeBalls(cache, 2, 1.2, 1.2);
  const auto with = [&](const std::string& setting) {
    std::vector<std::string> args = texturing(cache, out);
    args.insert(args.end(), {"--set", setting});
    return runProgram(args);
  };
  const std::string points = "point=[{value=300, factor=0.8}, {value=500, factor=1.2}]";
  const Finished done = with("texture.scale={by=\"attribute\", attribute=\"heat\", " + points + "}");
  INFO(done.all());
  REQUIRE(done.exitCode == 0);
  const auto surface = tools::readPly(out / "surface/0002.ply", 64, 64);
  REQUIRE_FALSE(surface.scale.empty());
  for (std::size_t v = 0; v < surface.positions.size(); ++v)
    CHECK(double(surface.scale[v]) == Approx(1.0 + double(surface.positions[v].z())).margin(0.02));

  // A frame without liquid has nothing to follow.
  const std::string first = readBytes(cache / "ball_0001.ply");
  std::ofstream(cache / "ball_0001.ply").close();
  CHECK(with("texture.scale={by=\"attribute\", attribute=\"heat\", " + points + "}").exitCode == 0);
  std::ofstream(cache / "ball_0001.ply") << first;

  const Finished missing = with("texture.scale={by=\"attribute\", attribute=\"cold\", " + points + "}");
  CHECK(missing.exitCode != 0);
  CHECK(missing.err.find("texture.scale.attribute: the liquid in") != std::string::npos);
  CHECK(missing.err.find("has no cold; there are: heat") != std::string::npos);
  const Finished turned = with("texture.orientation={align=\"attribute\", attribute=\"heat\"}");
  CHECK(turned.err.find("has no heat_x; there are: heat") != std::string::npos);
}

TEST_CASE("caches: files of a program that still runs are waited for", "[tools]") {
  const Scratch scratch;
  const fs::path cache = scratch.path / "balls", all = scratch.path / "all", out = scratch.path / "out";
  fs::create_directory(cache);
  fs::create_directory(all);
  writeBalls(all, 4, 1.2, 1.2);
  const auto arrive = [&](int frame) {
    const std::string name = "ball_000" + std::to_string(frame) + ".ply";
    fs::copy_file(all / name, cache / name);
  };
  arrive(1);
  std::vector<std::string> args = texturing(cache, out);
  args.push_back("--follow");
  CHECK(runProgram(args).err.find("give --set frames=N with --follow") != std::string::npos);
  args.insert(args.end(), {"--set", "frames=4"});
  std::thread program([&] {
    // Each after the one before is textured.
    for (int frame = 2; frame <= 4; ++frame) {
      const fs::path before = out / ("surface/000" + std::to_string(frame - 1) + ".ply");
      for (int n = 0; n < 1200 && !fs::exists(before); ++n)
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
      std::this_thread::sleep_for(std::chrono::milliseconds(500));
      arrive(frame);
    }
  });
  const Finished done = runProgram(args);
  program.join();
  INFO(done.all());
  REQUIRE(done.exitCode == 0);
  CHECK(done.all().find("waiting for ") != std::string::npos);
  CHECK(done.all().find("ball_0004.ply") != std::string::npos);
  CHECK(fs::exists(out / "surface/0004.ply"));
  CHECK(Json::parse(readBytes(out / "run.json"))["frames"][3]["explained"].get<double>() > 0.99);
}

TEST_CASE("caches: the folder in which one stands", "[tools]") {
  const Scratch scratch;
  const fs::path cache = scratch.path / "balls";
  fs::create_directory(cache);
  writeBalls(cache, 3, 1.2, 1.2);
  const Finished check = runProgram({"check", "."}, cache);
  INFO(check.all());
  CHECK(check.exitCode == 0);
  CHECK(check.out.find("ball_####.ply, meshes") != std::string::npos);
}

TEST_CASE("caches: velocities in another unit are refused with the factor that is missing", "[tools]") {
  const Scratch scratch;
  const fs::path cache = scratch.path / "balls", out = scratch.path / "out";
  fs::create_directory(cache);
  writeBalls(cache, 5, 1.2, 0.05);
  const Finished check = runProgram({"check", cache.string()});
  CHECK(check.exitCode == 0);
  CHECK(check.err.find("files.velocity_scale=24") != std::string::npos);
  const Finished done = runProgram(texturing(cache, out));
  CHECK(done.exitCode != 0);
  CHECK(done.err.find("files.velocity_scale=24") != std::string::npos);
  std::vector<std::string> scaled = texturing(cache, out);
  scaled.insert(scaled.end(), {"--set", "files.velocity_scale=24"});
  CHECK(runProgram(scaled).exitCode == 0);
}

TEST_CASE("caches: what is wrong with a cache is one sentence", "[tools]") {
  const Scratch scratch;
  const fs::path cache = scratch.path / "balls";
  fs::create_directory(cache);
  const auto wrong = [&](const std::vector<std::string>& args) {
    const Finished done = runProgram(args);
    CHECK(done.exitCode == 1);
    CHECK(std::count(done.err.begin(), done.err.end(), '\n') == 1);
    return done.err;
  };
  CHECK(wrong(texturing(cache, scratch.path / "out")).find("holds nothing") != std::string::npos);
  CHECK(wrong({"check", (scratch.path / "ball_####.ply").string()}).find("no file of this pattern") !=
        std::string::npos);
  writeBalls(cache, 3, 1.2, 1.2);
  CHECK(wrong({"check", cache.string(), "--frames", "1:200"}).find("are of 3 frames; give 1:3 at most") !=
        std::string::npos);
  CHECK(wrong({"texture", cache.string()}).find("--exemplar") != std::string::npos);
  fs::remove(cache / "ball_0002.ply");
  CHECK(wrong(texturing(cache, scratch.path / "out")).find("number 2 is missing") != std::string::npos);
}
