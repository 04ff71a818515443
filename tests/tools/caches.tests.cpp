// fluidtex simulate, texture and check: a liquid out of files.
#include "tests/tools/program.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>
#include <numbers>

namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

constexpr const char* kSmall = FLUIDTEX_SOURCE "/tests/tools/small.toml";
constexpr const char* kScales = FLUIDTEX_SOURCE "/scenes/exemplars/green_scales.png";

// A ball of radius 0.2 m that moves by `speed` m/s along x at 24 frames a second, with `written` as its
// velocity.
void writeBalls(const fs::path& folder, int frames, double speed, double written) {
  constexpr int kRings = 24, kAround = 48;
  for (int frame = 1; frame <= frames; ++frame) {
    std::string text, faces;
    int count = 0;
    for (int ring = 0; ring <= kRings; ++ring)
      for (int n = 0; n < kAround; ++n) {
        const double theta = std::numbers::pi * ring / kRings, phi = 2.0 * std::numbers::pi * n / kAround;
        text += std::to_string(0.2 * std::sin(theta) * std::cos(phi) + speed * (frame - 1) / 24.0) + " " +
                std::to_string(0.2 * std::sin(theta) * std::sin(phi)) + " " +
                std::to_string(0.2 * std::cos(theta)) + " " + std::to_string(written) + " 0 0\n";
        if (ring == kRings) continue;
        const int here = ring * kAround, next = here + kAround, after = (n + 1) % kAround;
        faces += "4 " + std::to_string(here + n) + " " + std::to_string(next + n) + " " +
                 std::to_string(next + after) + " " + std::to_string(here + after) + "\n";
        ++count;
      }
    char name[32];
    std::snprintf(name, sizeof name, "ball_%04d.ply", frame);
    std::ofstream(folder / name)
        << "ply\nformat ascii 1.0\nelement vertex " << (kRings + 1) * kAround
        << "\nproperty float x\nproperty float y\nproperty float z\nproperty float vx\nproperty float vy\n"
           "property float vz\nelement face "
        << count << "\nproperty list uchar int vertex_indices\nend_header\n"
        << text << faces;
  }
}

std::vector<std::string> texturing(const fs::path& cache, const fs::path& out) {
  return {"texture",
          cache.string(),
          "--exemplar",
          kScales,
          "--out",
          out.string(),
          "--no-render",
          "--set",
          "texture.points=1500",
          "--set",
          "texture.first_iterations=[1, 1, 1]"};
}

}  // namespace

TEST_CASE(
    "caches: texture from simulated files is the run's own, also where both went on from an earlier frame",
    "[tools]") {
  const Scratch scratch;
  const fs::path cache = scratch.path / "cache", whole = scratch.path / "whole", from = scratch.path / "from";
  REQUIRE(runProgram({"run", kSmall, "--out", whole.string(), "--quiet"}).exitCode == 0);
  REQUIRE(
      runProgram({"simulate", kSmall, "--cache", cache.string(), "--frames", "1:2", "--quiet"}).exitCode ==
      0);
  REQUIRE(runProgram({"simulate", kSmall, "--cache", cache.string(), "--resume", "--quiet"}).exitCode == 0);
  std::vector<std::string> run{"run",
                               kSmall,
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
  const Finished done = runProgram(texturing(cache, out));
  INFO(done.all());
  REQUIRE(done.exitCode == 0);
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
  CHECK(wrong({"texture", cache.string()}).find("--exemplar") != std::string::npos);
  fs::remove(cache / "ball_0002.ply");
  CHECK(wrong(texturing(cache, scratch.path / "out")).find("number 2 is missing") != std::string::npos);
}
