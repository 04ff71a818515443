// fluidtex compare: the command as a whole.
#include "tests/tools/program.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <fstream>

namespace fs = std::filesystem;

TEST_CASE("fluidtex compare: every variant's run, sheet, video and table", "[tools][slow]") {
  const Scratch scratch;
  // A name that means something to a shell, a web page or printf.
  const fs::path out = scratch.path / "Vergleich & 100 %d";
  const Finished run =
      runProgram({"compare", kSmallScene, "--frames", "1:2", "--no-report", "--out", out.string()});
  INFO(run.all());
  REQUIRE(run.exitCode == 0);
  for (const char* name : {"compare.jpg", "compare.mp4", "compare.md", "compare.json", "frames/0002.png"})
    CHECK(fs::file_size(out / name) > 100);
  // After one frame nothing is worth renewing yet, so what is carried is all there is in three of the
  // variants.
  std::vector<std::string> pictures;
  for (const std::string variant :
       {"untextured", "birth", "dual_rest", "advected", "alone", "scalars", "full"}) {
    std::string picture = readBytes(out / variant / "frames" / "0002.png");
    // So soon the two rest positions are one.
    if (variant != "advected" && variant != "scalars" && variant != "dual_rest")
      pictures.push_back(std::move(picture));
    CHECK(fs::exists(out / variant / "surface" / "0002.ply"));
  }
  // Each of the others looks like itself alone.
  std::sort(pictures.begin(), pictures.end());
  CHECK(std::unique(pictures.begin(), pictures.end()) == pictures.end());
  const auto json = nlohmann::json::parse(readBytes(out / "compare.json"));
  REQUIRE(json.size() == 7);
  CHECK(json.at(0).at("renewed") == 0.0);
  CHECK(json.at(1).at("shape").is_null());
  CHECK(json.at(3).at("renewed") == 0.0);
  CHECK(json.at(4).at("renewed") == 1.0);
  CHECK(json.at(6).at("renewed") < 1.0);
  CHECK(json.at(6).at("warp").is_number());
  CHECK_FALSE(fs::exists(out / "full" / "report.html"));
}

TEST_CASE("fluidtex run: the texture on a mesh of the user's own", "[tools]") {
  const Scratch scratch;
  // A square in the middle of the tank, of two triangles in an odd polygon file.
  for (const char* name : {"m_1.obj", "m_2.obj"})
    std::ofstream(scratch.path / name) << "v 0 0 3\nv 4 0 3\nv 4 6 3\nv 0 6 3\nf 1 2 3 4\n";
  const fs::path out = scratch.path / "out";
  const std::vector<std::string> common = {
      "run",   kSmallScene,  "--no-render", "--set", "frames=2", "--set", "texture.onto.scale=0.1",
      "--out", out.string(), "--set"};
  std::vector<std::string> missing = common, there = common;
  missing.push_back("texture.onto.files=" + (scratch.path / "none_%d.obj").string());
  there.push_back("texture.onto.files=" + (scratch.path / "m_%d.obj").string());
  const Finished refused = runProgram(missing);
  CHECK(refused.exitCode == 1);
  CHECK_THAT(refused.err, Catch::Contains("none_1.obj"));
  const Finished run = runProgram(there);
  INFO(run.all());
  REQUIRE(run.exitCode == 0);
  const std::string ply = readBytes(out / "onto" / "0002.ply");
  CHECK_THAT(ply, Catch::Contains("element vertex 4\n"));
  CHECK_THAT(ply, Catch::Contains("element face 2\n"));
  CHECK(fs::exists(out / "onto" / "0001.ply"));
}
