#include "tools/report/figures.h"

#include <catch2/catch.hpp>

#include <limits>

using namespace fluidtex::tools;

namespace {

Json sampleReport() {
  return Json::parse(R"({
    "version": "1.2.3", "seed": 7, "threads": 2,
    "scene": {"quality": "preview", "name": "dam", "frames": 48, "frame_rate": 25.0,
              "camera": {"from": [1, 2, 3], "at": [0, 0, 1]}, "render": {"size": [1280, 720]}},
    "frames": [{"frame": 1, "time": 0.0, "volume": 0.5, "deficit": null, "vertices": 4, "seconds": {"simulate": 2.5},
                "singular_points": [[1, 2, 3, 4]]},
               {"frame": 2, "time": 0.04, "volume": "much", "vertices": 5}]})");
}

}  // namespace

TEST_CASE("figures: what the page says of a run", "[tools]") {
  const Json figures = figuresOf(sampleReport(), {});
  CHECK(figures["title"] == "dam");
  CHECK(figures["version"] == "1.2.3");
  CHECK(figures["quality"] == "preview");
  CHECK(figures["total"] == 48);
  CHECK(figures["rate"] == 25.0);
  CHECK(figures["aspect"].get<double>() == Approx(16.0 / 9.0));
  CHECK(figures["camera"]["from"] == Json::parse("[1, 2, 3]"));
  REQUIRE(figures["frames"].size() == 2);
  CHECK(figures["frames"][0]["volume"] == 0.5);
  CHECK(figures["frames"][0]["seconds"]["simulate"] == 2.5);
  CHECK_FALSE(figures["frames"][0].contains("singular_points"));
}

TEST_CASE("figures: what is not known, or is no number, is null", "[tools]") {
  Json report = sampleReport();
  report["frames"][1]["renewed"] = std::numeric_limits<double>::quiet_NaN();
  const Json figures = Json::parse(figuresOf(report, {}).dump());
  CHECK(figures["frames"][0]["deficit"].is_null());
  CHECK(figures["frames"][0]["pop"].is_null());
  CHECK(figures["frames"][1]["volume"].is_null());
  CHECK(figures["frames"][1]["renewed"].is_null());
  CHECK(figures["frames"][1]["seconds"].empty());
}

TEST_CASE("figures: a report that lacks keys or holds others is shown as far as it goes", "[tools]") {
  const Json nothing = figuresOf(Json::object(), {});
  CHECK(nothing["frames"].empty());
  CHECK(nothing["aspect"].is_null());
  CHECK(nothing["camera"]["from"].size() == 3);
  const Json odd = figuresOf(
      Json::parse(R"({"scene": {"name": 3, "render": {"size": [16, 0]}, "camera": {"from": [1, "a", 2]}},
                                             "frames": [3, {}, {"frame": "x"}, {"frame": 9, "time": null}]})"),
      {});
  CHECK(odd["title"] == "");
  CHECK(odd["aspect"].is_null());
  CHECK(odd["camera"]["from"] == nothing["camera"]["from"]);
  REQUIRE(odd["frames"].size() == 1);
  CHECK(odd["frames"][0]["time"] == 0.0);
}

TEST_CASE("figures: warnings of the log, each once", "[tools]") {
  const Json figures = figuresOf(Json::object(),
                                 "[2026-01-01 10:00:00.000] [fluidtex] [info] frame 1 is no warning\n"
                                 "[2026-01-01 10:00:00.000] [fluidtex] [warning] a.png: is <small>\n"
                                 "[2026-01-01 10:00:01.000] [fluidtex] [warning] the second\n"
                                 "[2026-01-01 10:00:02.000] [fluidtex] [warning] a.png: is <small>\n"
                                 "[2026-01-01 10:00:02.000] [fluidtex] [warning] cut off");
  CHECK(figures["warnings"] == Json::parse(R"(["a.png: is <small>", "the second", "cut off"])"));
}
