// Meshes of users from the scene to the figures: what a solid of one holds, and what is said of one that does
// not fit.
#include "tests/sim/meshes/mesh_files.h"
#include "tests/tools/program.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <chrono>
#include <fstream>

namespace fs = std::filesystem;
using fluidtex::sim::boxObj;
using fluidtex::sim::kBoxFaces;
using fluidtex::sim::Vec3d;

namespace {

// The small scene with a liquid (a box's corners as text) and a solid of a mesh file, unless it has keys of
// its own.
std::vector<std::string> withMesh(const std::string& command, const fs::path& file, const std::string& liquid,
                                  const std::string& more = "") {
  return {command, kSmallScene,
          "--set", "liquid=[{ box = " + liquid + " }]",
          "--set", "solid=[{ mesh = { file = '" + file.string() + "'" + more + " } }]"};
}

fs::path written(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
  return file;
}

// The volume of the first frame, with the volume deficit of its surface.
double volumeOf(std::vector<std::string> args, const fs::path& out) {
  for (const char* more : {"--no-render", "--frames", "1:1", "--out"}) args.emplace_back(more);
  args.push_back(out.string());
  const Finished run = runProgram(args);
  INFO(run.all());
  REQUIRE(run.exitCode == 0);
  const nlohmann::json frame = nlohmann::json::parse(readBytes(out / "run.json")).at("frames").at(0);
  return frame.at("volume").get<double>() + frame.at("deficit").get<double>();
}

}  // namespace

TEST_CASE("meshes of users: liquid in the cavity of a mesh, and around blocks with a slit", "[tools]") {
  const Scratch scratch;
  std::string inner;
  for (const char c : kBoxFaces)
    inner += c >= '1' && c <= '8' ? std::to_string(c - '0' + 8) : std::string(1, c);
  const auto pair = [&](const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
    return boxObj(a, b, "") + boxObj(c, d, "") + kBoxFaces + inner;
  };
  // A tank of walls of three cells, in the planes of cells, filled to the height of three. Distances of a
  // mesh are interpolated between the corners of cells, which rounds its inner edges.
  const double h = 1.0 / 24.0;
  const fs::path tank = written(scratch.path / "tank.obj", pair(h * Vec3d(3, 1, 1), h * Vec3d(17, 14, 14),
                                                                h * Vec3d(6, 4, 4), h * Vec3d(14, 11, 11)));
  CHECK(
      volumeOf(withMesh("run", tank, "{ min = [0.25, 0.16667, 0.16667], max = [0.58333, 0.45833, 0.29167] }"),
               scratch.path / "held") == Approx(8 * 7 * 3 * h * h * h).epsilon(0.06));
  // Blocks 1.5 cells apart, in water: the slit is wet.
  const fs::path blocks = written(
      scratch.path / "blocks.obj",
      pair(Vec3d(0.2, 0.2, -0.1), Vec3d(0.45, 0.45, 0.5), Vec3d(0.5125, 0.2, -0.1), Vec3d(0.75, 0.45, 0.5)));
  CHECK(volumeOf(withMesh("run", blocks, "{ min = [0, 0, 0], max = [1, 0.625, 0.3] }"),
                 scratch.path / "slit") == Approx((0.625 - 0.25 * 0.25 - 0.2375 * 0.25) * 0.3).epsilon(0.01));
}

TEST_CASE(
    "meshes of users: whole numbers are read, damaged counts refused, and a mesh in millimetres told of",
    "[tools]") {
  const Scratch scratch;
  const std::string liquid = "{ min = [0, 0, 0], max = [1, 0.625, 0.3] }";
  std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty int16 x\nproperty int16 y\nproperty int16 "
      "z\nelement face "
      "4\nproperty list uchar ushort vertex_indices\nend_header\n0 0 0\n5 0 0\n0 5 0\n0 0 5\n3 0 2 1\n3 0 1 "
      "3\n3 0 3 "
      "2\n3 1 2 3\n";
  const Finished whole =
      runProgram(withMesh("check", written(scratch.path / "whole.ply", ply), liquid, ", scale = 0.1"));
  INFO(whole.all());
  CHECK(whole.exitCode == 0);
  CHECK_THAT(whole.err, !Catch::Contains("whole.ply"));

  ply.replace(ply.find("vertex 4"), 8, "vertex 4000000000");
  const auto start = std::chrono::steady_clock::now();
  const Finished damaged = runProgram(withMesh("run", written(scratch.path / "damaged.ply", ply), liquid));
  CHECK(damaged.exitCode == 1);
  CHECK_THAT(damaged.err, Catch::Contains("damaged.ply: says it has 4000000000 elements"));
  CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(5));

  const Finished large = runProgram(withMesh(
      "check", written(scratch.path / "large.obj", boxObj(Vec3d(300, 300, -100), Vec3d(700, 500, 600))),
      liquid));
  CHECK(large.exitCode == 0);
  CHECK_THAT(large.err,
             Catch::Contains("large.obj: lies outside the domain: it measures 400 x 200 x 700 m") &&
                 Catch::Contains("scale = 0.001 it would measure 0.4 x 0.2 x 0.7 m"));
  CHECK_THAT(runProgram(withMesh("check", scratch.path / "large.obj", liquid, ", scale = 0.001")).err,
             !Catch::Contains("large.obj"));
}
