#include "tools/report/write_report.h"
#include "tests/scratch.h"
#include "tests/tools/formats/sample_surface.h"
#include "tests/tools/program.h"
#include "tools/base/errors.h"
#include "tools/formats/ply.h"

#include <catch2/catch.hpp>

#include <chrono>

using namespace fluidtex;
using namespace fluidtex::tools;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

// A run of frames 1 to `frames` without pictures; the last has no surface.
void writeRun(const fs::path& out, int frames) {
  fs::create_directories(out / "surface");
  Json report = {{"version", "1"},
                 {"scene", {{"name", "small"}, {"texture", Json::object()}}},
                 {"frames", Json::array()}};
  for (int frame = 1; frame <= frames; ++frame) {
    const bool empty = frame == frames;
    char name[16];
    std::snprintf(name, sizeof name, "%04d.ply", frame);
    writePly(empty ? texture::TexturedSurface{} : sampleSurface(), {}, out / "surface" / name);
    report["frames"].push_back({{"frame", frame}, {"time", 0.1 * frame}, {"vertices", empty ? 0 : 4}});
  }
  std::ofstream(out / "run.json") << report;
}

// What the page holds of the run.
Json figuresIn(const fs::path& page) {
  const std::string text = readBytes(page), begin = "id=\"run\">";
  const std::size_t at = text.find(begin) + begin.size();
  return Json::parse(text.substr(at, text.find("</script>", at) - at));
}

}  // namespace

TEST_CASE("report: a run without pictures and video, in a folder with an odd name", "[tools]") {
  const Scratch scratch;
  const fs::path out = scratch.path / "a & <b> ü %s #";
  writeRun(out, 40);
  writeReport({out, out});
  const Json figures = figuresIn(out / "report.html");
  CHECK(figures["frames"].size() == 40);
  CHECK(figures["pictures"].empty());
  CHECK(figures["video"].is_null());
  // Of the last frame there is nothing to turn.
  CHECK(figures["meshes"].size() == 12);
  CHECK(figures["meshes"].front() == 1);
  CHECK(figures["meshes"].back() == 39);
  const std::string page = readBytes(out / "report.html");
  for (const Json& frame : figures["meshes"])
    CHECK(page.find("id=\"mesh-" + frame.dump() + "\"") != page.npos);
}

TEST_CASE("report: a video within its bound goes into the page, a larger one stays beside it", "[tools]") {
  const Scratch scratch;
  writeRun(scratch.path, 3);
  const fs::path video = scratch.path / "na <me>.mp4";
  std::ofstream(video) << "video";
  writeReport({scratch.path, scratch.path});
  CHECK(figuresIn(scratch.path / "report.html")["video"] ==
        Json{{"name", "na <me>.mp4"}, {"embedded", true}});
  CHECK_THAT(readBytes(scratch.path / "report.html"), Contains("id=\"video\">dmlkZW8=</script>"));
  // That of the scene, if there is one, is the run's.
  std::ofstream(scratch.path / "small.mp4") << "own";
  fs::last_write_time(scratch.path / "small.mp4", fs::last_write_time(video) - std::chrono::hours(1));
  writeReport({scratch.path, scratch.path});
  CHECK(figuresIn(scratch.path / "report.html")["video"]["name"] == "small.mp4");
  fs::remove(scratch.path / "small.mp4");
  fs::resize_file(video, kVideoBytes + 1);
  writeReport({scratch.path, scratch.path});
  CHECK(figuresIn(scratch.path / "report.html")["video"] ==
        Json{{"name", "na <me>.mp4"}, {"embedded", false}});
  CHECK(fs::file_size(scratch.path / "report.html") < 2'000'000);
}

TEST_CASE("report: what cannot be read is named, and an earlier page stays", "[tools]") {
  const Scratch scratch;
  CHECK_THROWS_AS(writeReport({scratch.path, scratch.path}), UsageError);
  writeRun(scratch.path, 3);
  writeReport({scratch.path, scratch.path});
  const std::string before = readBytes(scratch.path / "report.html");
  fs::create_directories(scratch.path / "frames");
  std::ofstream(scratch.path / "frames/0002.png") << "no picture";
  CHECK_THROWS_WITH(writeReport({scratch.path, scratch.path}), Contains("0002.png"));
  fs::remove_all(scratch.path / "frames");
  std::ofstream(scratch.path / "surface/0002.ply") << "no surface";
  CHECK_THROWS_WITH(writeReport({scratch.path, scratch.path}), Contains("0002.ply"));
  CHECK(readBytes(scratch.path / "report.html") == before);
}

TEST_CASE("report: a run writes it, another run takes its place, and the command writes it again",
          "[tools]") {
  const Scratch scratch;
  const fs::path out = scratch.path / "out", page = out / "report.html";
  const std::vector<std::string> run{"run", kSmallScene, "--out", out.string(), "--quiet", "--frames", "1:2"};
  REQUIRE(runProgram(run).exitCode == 0);
  const Json figures = figuresIn(page);
  CHECK(figures["frames"].size() == 2);
  CHECK(figures["pictures"] == Json::parse("[1, 2]"));
  CHECK(figures["meshes"] == Json::parse("[1, 2]"));
  CHECK(figures["video"]["embedded"] == true);
  std::vector<std::string> without = run;
  without.push_back("--no-report");
  REQUIRE(runProgram(without).exitCode == 0);
  CHECK_FALSE(fs::exists(page));
  const Finished again = runProgram({"report", out.string()});
  CHECK(again.exitCode == 0);
  CHECK(again.out == page.string() + "\n");
  CHECK(figuresIn(page)["pictures"] == figures["pictures"]);

  // Pictures of another camera in a folder of their own: their page has the run's figures and meshes.
  const fs::path closer = scratch.path / "closer";
  REQUIRE(runProgram({"render", kSmallScene, "--from", out.string(), "--out", closer.string(), "--quiet",
                      "--frames", "2"})
              .exitCode == 0);
  const Json rendered = figuresIn(closer / "report.html");
  CHECK(rendered["frames"].size() == 2);
  CHECK(rendered["pictures"] == Json::parse("[2]"));
  CHECK(rendered["meshes"] == Json::parse("[1, 2]"));

  const Finished none = runProgram({"report", closer.string()});
  CHECK(none.exitCode == 1);
  CHECK_THAT(none.err, Contains("run.json"));
}
