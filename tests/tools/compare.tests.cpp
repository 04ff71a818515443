// fluidtex compare: the pictures side by side, the table, and the command as a whole.
#include "tests/tools/program.h"
#include "tools/output/compare_table.h"
#include "tools/output/contact_sheet.h"

#include <OpenImageIO/imagebuf.h>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <fstream>

namespace fs = std::filesystem;
using namespace fluidtex::tools;

namespace {

fs::path writePicture(const fs::path& file, int width, int height, float red) {
  OIIO::ImageBuf image(OIIO::ImageSpec(width, height, 3, OIIO::TypeDesc::UINT8));
  for (OIIO::ImageBuf::Iterator<std::uint8_t> pixel(image); !pixel.done(); ++pixel) pixel[0] = red;
  image.write(file.string());
  return file;
}

std::array<float, 3> pixelOf(const OIIO::ImageBuf& image, int x, int y) {
  std::array<float, 3> rgb{};
  image.getpixel(x, y, rgb.data(), 3);
  return rgb;
}

}  // namespace

TEST_CASE("contact sheet: pictures in rows, scaled alike, with their names", "[tools]") {
  const Scratch scratch;
  const fs::path light = writePicture(scratch.path / "a.png", 80, 40, 1.0f),
                 dark = writePicture(scratch.path / "b.png", 160, 80, 0.5f);
  const fs::path file = scratch.path / "sheet.png";
  writeContactSheet({{light, ""}, {dark, ""}, {light, "name"}}, 2, 100, file);
  const OIIO::ImageBuf sheet(file.string());
  REQUIRE(sheet.spec().width % 2 == 0);
  REQUIRE(sheet.spec().height % 2 == 0);
  CHECK(sheet.spec().width >= 200);
  CHECK(sheet.spec().height >= 100);
  CHECK(pixelOf(sheet, 50, 25)[0] == Approx(1.0f).margin(0.02));
  CHECK(pixelOf(sheet, 154, 25)[0] == Approx(0.5f).margin(0.02));
  CHECK(pixelOf(sheet, 90, 90)[0] == Approx(1.0f).margin(0.02));
  CHECK(pixelOf(sheet, 154, 90)[0] == 0.0f);  // there is no fourth picture
  // Where the name stands there is something else than red.
  int lettered = 0;
  for (int y = 54; y < 70; ++y) {
    for (int x = 0; x < 60; ++x) lettered += pixelOf(sheet, x, y)[1] > 0.5f || pixelOf(sheet, x, y)[0] < 0.5f;
  }
  CHECK(lettered > 20);
  CHECK_THROWS_WITH(writeContactSheet({{scratch.path / "missing.png", ""}}, 1, 100, file),
                    Catch::Contains("missing.png"));
  CHECK_THROWS_AS(writeContactSheet({}, 1, 100, file), std::runtime_error);
}

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

TEST_CASE("fluidtex compare: every variant's run, sheet, video and table", "[tools][slow]") {
  const Scratch scratch;
  const fs::path out = scratch.path / "out";
  const Finished run = runProgram({"compare", kSmallScene, "--frames", "1:2", "--out", out.string()});
  INFO(run.all());
  REQUIRE(run.exitCode == 0);
  for (const char* name : {"compare.jpg", "compare.mp4", "compare.md", "compare.json", "frames/0002.png"})
    CHECK(fs::file_size(out / name) > 100);
  // After one frame nothing is worth renewing yet, so what is carried is all there is in three of the
  // variants.
  std::vector<std::string> pictures;
  for (const std::string variant : {"untextured", "advected", "alone", "scalars", "full"}) {
    std::string picture = readBytes(out / variant / "frames" / "0002.png");
    if (variant != "advected" && variant != "scalars") pictures.push_back(std::move(picture));
    CHECK(fs::exists(out / variant / "surface" / "0002.ply"));
  }
  // Each of the others looks like itself alone.
  std::sort(pictures.begin(), pictures.end());
  CHECK(std::unique(pictures.begin(), pictures.end()) == pictures.end());
  const auto json = nlohmann::json::parse(readBytes(out / "compare.json"));
  REQUIRE(json.size() == 5);
  CHECK(json.at(0).at("renewed") == 0.0);
  CHECK(json.at(1).at("renewed") == 0.0);
  CHECK(json.at(2).at("renewed") == 1.0);
  CHECK(json.at(4).at("renewed") < 1.0);
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
