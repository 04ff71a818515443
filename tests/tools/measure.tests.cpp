// fluidtex measure: a run's figures, and where they go.
#include "tests/tools/program.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <fstream>

namespace fs = std::filesystem;
using Json = nlohmann::json;

TEST_CASE("fluidtex measure: fills the report of a run and writes all figures", "[tools][slow]") {
  const Scratch scratch;
  const fs::path out = scratch.path / "out", json = scratch.path / "Maße & Werte.json";
  // Of fewer points hardly a tile is flat enough to be judged.
  REQUIRE(runProgram({"run", kSmallScene, "--out", out.string(), "--frames", "1:3", "--no-render", "--set",
                      "texture.points=5000"})
              .exitCode == 0);
  const fs::path motion = scratch.path / "motion";
  const Finished done = runProgram(
      {"measure", out.string(), "--json", json.string(), "--every", "2", "--motion", motion.string()});
  INFO(done.err);
  REQUIRE(done.exitCode == 0);
  CHECK_THAT(done.out, Catch::Contains("likeness") && Catch::Contains("mean"));
  const Json figures = Json::parse(readBytes(json)), report = Json::parse(readBytes(out / "run.json"));
  REQUIRE(figures["frames"].size() == 3);
  CHECK(figures["spacing"].get<double>() == report["frames"][0]["spacing"].get<double>());
  for (int n = 0; n < 3; ++n) {
    INFO(n);
    const Json &frame = figures["frames"][n], &record = report["frames"][n];
    CHECK(frame["frame"] == n + 1);
    CHECK(frame.contains("likeness") == (n != 1));
    CHECK(frame.contains("contrast") == (n != 1));
    CHECK(frame.contains("spectrum") == (n != 1));
    CHECK(frame.contains("pop") == (n > 0));
    CHECK(frame.contains("warp") == (n > 0));
    CHECK(record["sharpness"].is_number() == (n != 1));
    CHECK(record["change_along_flow"].is_number() == (n > 0));
  }
  CHECK(figures["frames"][2]["likeness"] == report["frames"][2]["likeness"]);
  CHECK(figures["frames"][0]["shape"].get<double>() >= 1.0);
  CHECK(figures["mean"]["pop"] ==
        (figures["frames"][1]["pop"].get<double>() + figures["frames"][2]["pop"].get<double>()) / 2);
  CHECK(filesIn(motion) ==
        std::vector<std::string>{"0001.flo", "0001.png", "0002.flo", "0002.png", "0003.flo", "0003.png"});
  // The same once more: nothing in it depends on chance.
  REQUIRE(runProgram({"measure", out.string(), "--json", (scratch.path / "n.json").string(), "--every", "2"})
              .exitCode == 0);
  CHECK(readBytes(scratch.path / "n.json") == readBytes(json));

  // Nor on the frames that are measured before it.
  fs::create_directory(scratch.path / "alone");
  fs::copy(out / "run.json", scratch.path / "alone" / "run.json");
  fs::create_directory(scratch.path / "alone" / "surface");
  fs::copy(out / "surface" / "0003.ply", scratch.path / "alone" / "surface" / "0003.ply");
  const fs::path third = scratch.path / "third.json";
  REQUIRE(runProgram({"measure", (scratch.path / "alone").string(), "--json", third.string()}).exitCode == 0);
  const Json alone = Json::parse(readBytes(third))["frames"][0];
  for (const char* key :
       {"likeness", "sharpness", "coverage", "contrast", "repeats", "shape", "seams", "chips"})
    CHECK(alone[key] == figures["frames"][2][key]);

  fs::remove(out / "surface" / "0002.ply");
  REQUIRE(runProgram({"measure", out.string(), "--json", json.string(), "--quiet"}).exitCode == 0);
  CHECK_FALSE(Json::parse(readBytes(json))["frames"][1].contains("pop"));
}

TEST_CASE("fluidtex measure: a folder that holds no run is refused in one sentence", "[tools]") {
  const Scratch scratch;
  const auto refusedFor = [&](const std::string& why) {
    const Finished done = runProgram({"measure", scratch.path.string()});
    CHECK(done.exitCode == 1);
    CHECK_THAT(done.err, Catch::StartsWith("error: ") && Catch::Contains(why));
    CHECK(std::count(done.err.begin(), done.err.end(), '\n') == 1);
  };
  refusedFor("run.json: cannot be read");
  std::ofstream(scratch.path / "run.json") << "{\"frames\": []";
  refusedFor("run.json: is no report of a run");
  for (const char* odd :
       {R"([])", R"({"scene": 1, "frames": []})", R"({"scene": {"texture": {"exemplar": 3}}, "frames": []})",
        R"({"scene": {"texture": {"toroidal": "yes"}}, "frames": []})",
        R"({"scene": {"texture": {}}, "frames": [1]})",
        R"({"scene": {"texture": {}}, "frames": [{"frame": "one"}]})"}) {
    std::ofstream(scratch.path / "run.json") << odd;
    refusedFor("run.json: is no report of a run");
  }
  const auto write = [&](const std::string& exemplar) {
    std::ofstream(scratch.path / "run.json")
        << R"({"scene": {"texture": {"exemplar": ")" << exemplar << R"("}}, "frames": []})";
  };
  write("/no/such.png");
  refusedFor("/no/such.png: the exemplar of the run is not there");
  write(FLUIDTEX_SOURCE "/scenes/exemplars/green_scales.png");
  refusedFor("holds no surface");
}
