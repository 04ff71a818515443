#include "tools/report.h"

#include <catch2/catch.hpp>

using namespace fluidtex;

TEST_CASE("run.json: what was written is read back, frame by frame", "[tools]") {
  tools::Report report;
  report.scene = R"({"seed":3,"texture":{"points":100}})";
  report.seed = 3;
  report.threads = 2;
  report.frames = {tools::frameRecord({}, {}, {}, {}, {}), tools::frameRecord({}, {}, {}, {}, {})};
  const tools::Report back = tools::parseReport(tools::toJson(report));
  CHECK(back.scene == report.scene);
  CHECK(back.seed == 3);
  CHECK(back.threads == 2);
  CHECK(back.frames == report.frames);
  CHECK_THROWS_WITH(tools::parseReport("{}"), Catch::Contains("damaged"));
}

TEST_CASE("run.json: a frame has every key, and null where nothing is known", "[tools]") {
  const std::string record = tools::frameRecord({}, {}, {}, {}, {});
  for (const char* key : {"frame",        "time",       "substeps",          "dt_min",
                          "cells",        "volume",     "vertices",          "triangles",
                          "components",   "edge_mean",  "edge_cv",           "singularities",
                          "energy_start", "energy_end", "iterations",        "renewed",
                          "likeness",     "sharpness",  "change_along_flow", "seconds",
                          "simulate",     "prepare",    "transport",         "synthesize",
                          "render",       "write",      "peak_rss"})
    CHECK_THAT(record, Catch::Contains("\"" + std::string(key) + "\":"));
  CHECK_THAT(record, Catch::Contains("\"energy_end\":null"));
}

TEST_CASE("resume: scenes are the same but for the number of frames, or the first difference is named",
          "[tools]") {
  const std::string scene = R"({"frames":10,"texture":{"windows":[33,17]}})";
  CHECK(tools::sceneDifference(scene, R"({"frames":20,"texture":{"windows":[33,17]}})").empty());
  CHECK(tools::sceneDifference(scene, R"({"frames":10,"texture":{"windows":[33,15]}})") ==
        "texture.windows.1 was 17 and is 15");
  CHECK(tools::sceneDifference(scene, R"({"frames":10,"texture":{"windows":[33]}})") ==
        "texture.windows.1 was 17 and is not there");
}
