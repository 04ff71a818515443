#include "tools/frames/export_frame.h"

#include "tests/scratch.h"
#include "tests/tools/frames/run_of_samples.h"
#include "texture/exemplar/read_image.h"
#include "tools/base/errors.h"
#include "tools/run_folder/journal.h"

#include <catch2/catch.hpp>

using namespace fluidtex;
using namespace fluidtex::tools;
namespace fs = std::filesystem;

TEST_CASE("export frame: how a run looks is said by its scene, else as usual", "[tools]") {
  const Appearance usual = appearanceOf(Json::object(), sampleColor());
  CHECK(usual.name == Appearance{}.name);
  CHECK(usual.frameRate == Appearance{}.frameRate);
  CHECK(usual.picture.empty());
  CHECK_FALSE(usual.toroidal);
  CHECK_FALSE(usual.seeThrough);
  CHECK(usual.gloss == Appearance{}.gloss);
  CHECK(usual.roughness == Appearance{}.roughness);
  texture::Image glass = sampleColor();
  glass.at(3, 2)[3] = 0.5f;
  const Appearance said = appearanceOf(
      {{"name", "dam"},
       {"frame_rate", 30.0},
       {"texture", {{"method", "coordinates"}, {"later_frames", "synthesize"}, {"toroidal", true}}},
       {"render", {{"gloss", 0.25}, {"roughness", 0.5}}}},
      glass);
  CHECK(said.name == "dam");
  CHECK(said.frameRate == 30.0);
  CHECK(said.picture == "exemplar.png");
  CHECK(said.toroidal);
  CHECK(said.seeThrough);
  CHECK(said.gloss == 0.25);
  CHECK(said.roughness == 0.5);
}

TEST_CASE("export frame: the picture is the one that colours are looked up in, if they are", "[tools]") {
  const auto pictureOf = [](const char* method, const char* later, const char* between) {
    return appearanceOf({{"texture", {{"method", method}, {"later_frames", later}, {"between", between}}}},
                        sampleColor())
        .picture;
  };
  CHECK(pictureOf("coordinates", "synthesize", "points") == "exemplar.png");
  CHECK(pictureOf("coordinates", "alone", "exemplar") == "exemplar.png");
  CHECK(pictureOf("coordinates", "synthesize", "file") == "between.png");
  CHECK(pictureOf("coordinates", "advect", "file").empty());
  CHECK(pictureOf("kwatra07", "synthesize", "file").empty());
}

TEST_CASE("export frame: what no run has written is named", "[tools]") {
  for (const Json& wrong :
       {Json{{"frame_rate", "fast"}}, Json{{"name", 3}}, Json{{"texture", {{"toroidal", 1.5}}}},
        Json{{"render", {{"gloss", Json::array()}}}}}) {
    INFO(wrong);
    CHECK_THROWS_AS(appearanceOf(wrong, sampleColor()), UsageError);
    CHECK_THROWS_WITH(appearanceOf(wrong, sampleColor()), Catch::StartsWith("run.json: /"));
  }
}

TEST_CASE("export frame: pictures are written once, a finer one where there is one", "[tools]") {
  const Scratch scratch;
  writePictures(scratch.path, sampleColor(), {});
  CHECK(filesIn(scratch.path) == std::vector<std::string>{"exemplar.png"});
  const std::string exemplar = readBytes(scratch.path / "exemplar.png");
  CHECK(texture::readImage(scratch.path / "exemplar.png").width == 8);
  std::ofstream(scratch.path / "exemplar.png") << "the user's";
  fs::create_directory(scratch.path / "other");
  std::ofstream(scratch.path / "other" / "fine.png", std::ios::binary) << exemplar;
  writePictures(scratch.path, sampleColor(), scratch.path / "other" / "fine.png");
  CHECK(readBytes(scratch.path / "exemplar.png") == "the user's");
  CHECK(readBytes(scratch.path / "between.png") == exemplar);
}

TEST_CASE("export frame: a frame's files, the list of them and their journal", "[tools]") {
  const Scratch scratch;
  makeRunOfSamples(scratch.path, 3);
  const Exports exports = sampleExports({"glb", "vtp"});
  exportFrame(scratch.path, 3, exports, sampleColor());
  exportFrame(scratch.path, 1, exports, sampleColor());
  CHECK(filesIn(scratch.path) == std::vector<std::string>{"glb/0001.glb", "glb/0003.glb", "sample.pvd",
                                                          "state/journal.txt", "surface/0001.ply",
                                                          "surface/0002.ply", "surface/0003.ply",
                                                          "vtp/0001.vtp", "vtp/0003.vtp"});
  const Journal journal = readJournal(scratch.path);
  for (const char* name : {"glb/0001.glb", "glb/0003.glb", "vtp/0001.vtp", "vtp/0003.vtp"})
    CHECK(isWhole(journal, scratch.path, name));
  CHECK(journal.files.size() == 3 + 4);  // the surfaces were in it before
  // Frame 3 of 10 a second.
  CHECK_THAT(readBytes(scratch.path / "sample.pvd"),
             Catch::Contains("timestep=\"0.2\"") && Catch::Contains("vtp/0003.vtp"));
}

TEST_CASE("export frame: stretch is told in the spacing given, or in that of run.json", "[tools]") {
  const Scratch scratch;
  makeRunOfSamples(scratch.path, 2);
  std::ofstream(scratch.path / "run.json")
      << R"({"scene": {"texture": {}}, "frames": [{"frame": 1, "spacing": 0.25}]})";
  const auto bytes = [&](int frame, std::optional<double> spacing) {
    exportFrame(scratch.path, frame, sampleExports({"usda"}), sampleColor(), spacing);
    return readBytes(scratch.path / frameFile(Format::usda, frame));
  };
  const std::string told = bytes(1, {});
  CHECK_THAT(told, Catch::Contains("stretch"));
  CHECK(bytes(1, 0.25) == told);
  CHECK(bytes(1, 0.5) != told);
}

TEST_CASE("export frame: elsewhere the files are the same, and nothing else is touched", "[tools]") {
  const Scratch scratch;
  makeRunOfSamples(scratch.path / "run", 2);
  const Exports exports = sampleExports({"glb", "obj", "usda", "vtp"});
  const std::vector<std::string> before = filesIn(scratch.path / "run");
  const std::string journal = readBytes(scratch.path / "run" / "state" / "journal.txt");
  writeFrameExports(scratch.path / "run", 2, exports, sampleColor(), scratch.path / "to");
  CHECK(filesIn(scratch.path / "run") == before);
  CHECK(readBytes(scratch.path / "run" / "state" / "journal.txt") == journal);
  exportFrame(scratch.path / "run", 2, exports, sampleColor());
  for (const char* name : {"glb/0002.glb", "obj/0002.obj", "usd/0002.usda", "vtp/0002.vtp"}) {
    INFO(name);
    CHECK(!readBytes(scratch.path / "to" / name).empty());
    CHECK(readBytes(scratch.path / "to" / name) == readBytes(scratch.path / "run" / name));
  }
}

TEST_CASE("export frame: a folder without a journal gets none", "[tools]") {
  const Scratch scratch;
  makeRunOfSamples(scratch.path, 1);
  fs::remove_all(scratch.path / "state");
  exportFrame(scratch.path, 1, sampleExports({"glb"}), sampleColor());
  CHECK(filesIn(scratch.path) == std::vector<std::string>{"glb/0001.glb", "surface/0001.ply"});
}

TEST_CASE("export frame: what is no surface of a run is refused", "[tools]") {
  const Scratch scratch;
  makeRunOfSamples(scratch.path, 1);
  std::ofstream(scratch.path / "surface" / "0001.ply") << "ply\n";
  CHECK_THROWS_AS(exportFrame(scratch.path, 1, sampleExports({"glb"}), sampleColor()), UsageError);
  CHECK_THROWS_WITH(exportFrame(scratch.path, 1, sampleExports({"glb"}), sampleColor()),
                    Catch::Contains("0001.ply"));
}
