#include "tools/summaries/compare_table.h"

#include "tests/scratch.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <fstream>

using namespace fluidtex::tools;

TEST_CASE("compare table: means over the frames after the first surface, what is not known stays unknown",
          "[tools]") {
  const Scratch scratch;
  std::ofstream(scratch.path / "run.json") << R"({"frames": [
    {"vertices": 0, "renewed": null, "seconds": {"transport": 5, "synthesize": 5}},
    {"vertices": 7, "renewed": 1.0, "seconds": {"transport": 5, "synthesize": 5}},
    {"vertices": 7, "renewed": 0.25, "seconds": {"transport": 1, "synthesize": 2}},
    {"vertices": 7, "renewed": 0.75, "seconds": {"transport": 2, "synthesize": 3}}]})";
  CHECK(!comparedRun("ours", scratch.path).likeness);
  std::ofstream(scratch.path / "measure.json") << R"({"frames": [], "mean": {"likeness": 0.8, "pop": 0.25}})";
  const Compared row = comparedRun("ours", scratch.path);
  CHECK(*row.renewed == Approx(0.5));
  CHECK(*row.likeness == Approx(0.8));
  CHECK(*row.seconds == Approx(4.0));
  CHECK(*row.pop == 0.25);
  CHECK(!row.shape);
  const std::string markdown = toMarkdown({row});
  CHECK_THAT(markdown, Catch::Contains("| ours | 0.8 | - |"));
  const auto json = nlohmann::json::parse(toJson({row}));
  CHECK(json.at(0).at("variant") == "ours");
  CHECK(json.at(0).at("renewed") == 0.5);
  CHECK(json.at(0).at("pop") == 0.25);
  CHECK(json.at(0).at("shape").is_null());
  CHECK_THROWS_AS(comparedRun("none", scratch.path / "elsewhere"), std::runtime_error);
}

TEST_CASE("compare table: a folder without a run, and a damaged report, are refused", "[tools]") {
  const Scratch scratch;
  CHECK_THROWS_AS(comparedRun("none", scratch.path), std::runtime_error);
  std::ofstream(scratch.path / "run.json") << R"({"frames": [)";
  CHECK_THROWS_AS(comparedRun("cut", scratch.path), std::runtime_error);
}
