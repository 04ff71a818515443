#include "tools/run_folder/finished_run.h"

#include "tests/scratch.h"
#include "tests/tools/output/sample_surface.h"
#include "tools/base/errors.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <fstream>

using namespace fluidtex;
using namespace fluidtex::tools;
using Catch::Matchers::Contains;

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
