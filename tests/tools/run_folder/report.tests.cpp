#include "tools/run_folder/report.h"

#include "tests/tools/formats/sample_surface.h"

#include <catch2/catch.hpp>

using namespace fluidtex;

namespace {

tools::Json record(const texture::TexturedSurface& surface = {},
                   const texture::SynthesisStats& synthesis = {}) {
  tools::Json record = tools::frameRecord({}, surface, {}, synthesis);
  tools::recordCost(record, {});
  return record;
}

}  // namespace

TEST_CASE("run.json: what was written is read back, frame by frame", "[tools]") {
  tools::Report report;
  report.scene = tools::Json::parse(R"({"seed":3,"texture":{"points":100}})");
  report.seed = 3;
  report.threads = 2;
  report.frames = {record(), record(sampleSurface())};
  const tools::Report back = tools::parseReport(tools::toJson(report));
  CHECK(back.scene == report.scene);
  CHECK(back.seed == 3);
  CHECK(back.threads == 2);
  CHECK(back.frames == report.frames);
  CHECK_THROWS_WITH(tools::parseReport("{}"), Catch::Contains("damaged"));
}

TEST_CASE("run.json: a frame has every key, and null where nothing is known", "[tools]") {
  const std::string text = record().dump();
  for (const char* key : {"frame",
                          "time",
                          "substeps",
                          "dt_min",
                          "cells",
                          "volume",
                          "vertices",
                          "triangles",
                          "components",
                          "edge_mean",
                          "edge_cv",
                          "singularities",
                          "energy_start",
                          "energy_end",
                          "iterations",
                          "renewed",
                          "likeness",
                          "sharpness",
                          "change_along_flow",
                          "seconds",
                          "simulate",
                          "prepare",
                          "transport",
                          "synthesize",
                          "spacing",
                          "render",
                          "write",
                          "peak_rss",
                          "singular_points",
                          "folded",
                          "spikes"})
    CHECK_THAT(text, Catch::Contains("\"" + std::string(key) + "\":"));
  CHECK_THAT(text, Catch::Contains("\"energy_end\":null"));
}

TEST_CASE("run.json: the energy is known only where something was optimised", "[tools]") {
  texture::SynthesisStats stats;
  stats.energyStart = 3.0, stats.energyEnd = 2.0;
  for (const char* key : {"energy_start", "energy_end"}) CHECK(record(sampleSurface(), stats)[key].is_null());
  stats.iterations = 1;
  CHECK(record(sampleSurface(), stats)["energy_start"] == 3.0);
  CHECK(record(sampleSurface(), stats)["energy_end"] == 2.0);
}

TEST_CASE("run.json: points where the orientation turns are counted and listed", "[tools]") {
  const std::vector<texture::Singularity> two = {{{1, 2, 3}, 1}, {{4, 5, 6}, -2}};
  const tools::Json record = tools::frameRecord({}, sampleSurface(), two, {});
  CHECK(record["singularities"] == 2);
  CHECK(record["singular_points"].dump() == "[[1.0,2.0,3.0,1],[4.0,5.0,6.0,-2]]");
}

TEST_CASE("run.json: a cost that is recorded again takes the place of the first", "[tools]") {
  tools::Json frame = record();
  const std::size_t keys = frame.size();
  tools::StageSeconds seconds;
  seconds.write = 4.0;
  tools::recordCost(frame, seconds);
  CHECK(frame["seconds"]["write"] == 4.0);
  CHECK(frame.size() == keys);
}

TEST_CASE("resume: scenes are the same but for the number of frames, or the first difference is named",
          "[tools]") {
  const auto difference = [](const char* before, const char* now) {
    return tools::sceneDifference(tools::Json::parse(before), tools::Json::parse(now));
  };
  const char* scene = R"({"frames":10,"texture":{"windows":[33,17]}})";
  CHECK(difference(scene, R"({"frames":20,"texture":{"windows":[33,17]}})").empty());
  CHECK(difference(scene, R"({"frames":10,"texture":{"windows":[33,15]}})") ==
        "texture.windows.1 was 17 and is 15");
  CHECK(difference(scene, R"({"frames":10,"texture":{"windows":[33]}})") ==
        "texture.windows.1 was 17 and is not there");
}

TEST_CASE("resume: a camera that turns is spread over all frames, so that their number has to stay",
          "[tools]") {
  const auto difference = [](const char* before, const char* now) {
    return tools::sceneDifference(tools::Json::parse(before), tools::Json::parse(now));
  };
  CHECK(
      difference(R"({"frames":10,"camera":{"turn":0.0}})", R"({"frames":20,"camera":{"turn":0.0}})").empty());
  CHECK(difference(R"({"frames":10,"camera":{"turn":5.0}})", R"({"frames":20,"camera":{"turn":5.0}})") ==
        "frames was 10 and is 20");
}
