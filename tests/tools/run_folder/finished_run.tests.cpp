#include "tools/run_folder/finished_run.h"

#include "tests/scratch.h"
#include "tests/tools/formats/sample_surface.h"
#include "tests/tools/program.h"
#include "tools/base/errors.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <fstream>

using namespace fluidtex;
using namespace fluidtex::tools;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

TEST_CASE("finished run: records by frame, and the files' names", "[tools]") {
  FinishedRun run;
  run.out = "out";
  run.report = Json::parse(R"({"frames": [{"frame": 3, "spacing": 0.25}, {"frame": 4}]})");
  REQUIRE(recordOf(run, 3) != nullptr);
  CHECK(recordOf(run, 3)->at("spacing") == 0.25);
  CHECK(recordOf(run, 5) == nullptr);
  CHECK(run.surfaceOf(4) == "out/surface/0004.ply");
}

TEST_CASE("finished run: the spacing is the report's, else one vertex stands for one texel", "[tools]") {
  FinishedRun run;
  run.report = Json::parse(R"({"frames": [{"frame": 3, "spacing": 0.25}, {"frame": 4}]})");
  const texture::TexturedSurface surface = sampleSurface();
  CHECK(spacingOf(run, surface, 3) == 0.25);
  // A tetrahedron with three right angles: 3/2 + sqrt(3)/2, of four vertices.
  const double expected = std::sqrt((1.5 + 0.5 * std::sqrt(3.0)) / 4.0);
  CHECK(spacingOf(run, surface, 4) == Approx(expected));
  const Scratch scratch;
  CHECK(spacingOf(scratch.path, surface, 1) == Approx(expected));
}

TEST_CASE("finished run: a folder that is not there, or holds no run, is refused by name", "[tools]") {
  const Scratch scratch;
  CHECK(existing(scratch.path) == scratch.path);
  CHECK_THROWS_AS(existing(scratch.path / "none"), UsageError);
  CHECK_THROWS_WITH(openRun(scratch.path, {}), Contains("run.json") && Contains("cannot be read"));
  std::ofstream(scratch.path / "run.json") << R"({"frames": 3})";
  CHECK_THROWS_WITH(openRun(scratch.path, {}), Contains("is no report of a run"));
  std::ofstream(scratch.path / "run.json")
      << R"({"scene": {"texture": {"exemplar": "/nowhere/a.png"}}, "frames": []})";
  CHECK_THROWS_WITH(openRun(scratch.path, {}), Contains("/nowhere/a.png") && Contains("--exemplar"));
}

TEST_CASE("fluidtex measure: a run that was killed has all its frames", "[tools]") {
  const Scratch scratch;
  const fs::path out = scratch.path / "out";
  REQUIRE(
      runProgram({"run", kSmallScene, "--no-render", "--frames", "1:3", "--out", out.string()}).exitCode ==
      0);
  auto report = fluidtex::tools::Json::parse(readBytes(out / "run.json"));
  const auto whole = report.at("frames");
  report["frames"].erase(1);
  report["frames"].erase(1);
  std::ofstream(out / "run.json") << report.dump();
  REQUIRE(runProgram({"measure", out.string(), "--quiet"}).exitCode == 0);
  const auto frames = fluidtex::tools::Json::parse(readBytes(out / "run.json")).at("frames");
  REQUIRE(frames.size() == 3);
  CHECK(frames[2].at("volume") == whole[2].at("volume"));
  CHECK(frames[2].at("likeness").is_number());
}
