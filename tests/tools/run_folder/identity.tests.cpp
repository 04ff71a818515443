// fluidtex run --resume: goes on only with the files that it began with, and with results that are as it
// wrote them.
#include "tests/tools/program.h"
#include "tools/run_folder/report.h"

#include <OpenImageIO/imageio.h>
#include <openvdb/openvdb.h>
#include <catch2/catch.hpp>

#include <cmath>
#include <fstream>

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

namespace {

const fs::path kExemplars = FLUIDTEX_SOURCE "/scenes/exemplars";

// Grey waves of 8 bits; another `phase`, another picture of the same size.
void writeImage(const fs::path& file, int size, int channels, double phase = 0.0) {
  std::vector<std::uint8_t> pixels;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x)
      for (int c = 0; c < channels; ++c)
        pixels.push_back(
            std::uint8_t(std::lround(127.5 + 100.0 * std::sin(0.2 * x + phase + c) * std::cos(0.3 * y))));
  const auto out = OIIO::ImageOutput::create(file.string());
  REQUIRE(out);
  REQUIRE(out->open(file.string(), OIIO::ImageSpec(size, size, channels, OIIO::TypeDesc::UINT8)));
  REQUIRE(out->write_image(OIIO::TypeDesc::UINT8, pixels.data()));
  REQUIRE(out->close());
}

// A block on the floor, or hanging at the height `low`.
void writeBlock(const fs::path& file, double low) {
  std::ofstream out(file);
  for (int n = 0; n < 8; ++n)
    out << "v " << 0.5 + 0.1 * (n & 1) << ' ' << 0.2 + 0.1 * (n >> 1 & 1) << ' ' << low + 0.1 * (n >> 2)
        << '\n';
  out << "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
}

void writeField(const fs::path& file, float x) {
  openvdb::initialize();
  const auto grid = openvdb::Vec3SGrid::create(openvdb::Vec3f(x, 1.0f, 0.0f));
  grid->tree().setValueOn({0, 0, 0}, openvdb::Vec3f(x, 1.0f, 0.0f));
  openvdb::io::File(file.string()).write({grid});
}

Words with(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

}  // namespace

TEST_CASE(
    "fluidtex run --resume: a file whose content has changed is named and refused, one that was only touched "
    "or "
    "moved is not",
    "[tools][slow]") {
  const Scratch scratch;
  const auto at = [&](const char* name) { return (scratch.path / name).string(); };
  writeImage(at("exemplar.png"), 64, 3);
  writeImage(at("map.png"), 64, 1);
  writeImage(at("guidance.png"), 64, 1);
  writeImage(at("ground.png"), 16, 1);
  writeBlock(at("block.obj"), 0.0);
  writeBlock(at("block1.obj"), 0.3);
  writeBlock(at("block2.obj"), 0.3);
  writeBlock(at("onto1.obj"), 0.3);
  writeBlock(at("onto2.obj"), 0.3);
  writeField(at("field.vdb"), 0.5f);
  const auto settings = [](const std::string& folder) {
    const auto in = [&](const char* name) { return "'" + folder + "/" + name + "'"; };
    return Words{"--exemplar",
                 folder + "/exemplar.png",
                 "--set",
                 "texture.map=[{ name = 'shade', file = " + in("map.png") + " }]",
                 "--set",
                 "texture.guidance={ by = 'height', map = " + in("guidance.png") +
                     ", point = [{ value = 0.0, level = 0.0 }, { value = 0.5, level = 1.0 }] }",
                 "--set",
                 "texture.orientation={ align = 'field', field = " + in("field.vdb") + " }",
                 "--set",
                 "texture.onto={ files = " + in("onto%d.obj") + ", first = 1 }",
                 "--set",
                 "solid=[{ mesh = { file = " + in("block.obj") +
                     " } }, { mesh_sequence = { files = " + in("block%d.obj") +
                     ", first = 1, last = 2 } }, { height_field = { file = " + in("ground.png") +
                     ", pixel = 0.1, low = 0.0, high = 0.05 } }]"};
  };
  const fs::path out = scratch.path / "out";
  const Words run{"run", kSmallScene, "--no-render", "--out", out.string(), "--set", "texture.points=1000"};
  const Words own = with(run, settings(scratch.path.string()));
  const Finished first = runProgram(with(own, {"--set", "frames=1"}));
  INFO(first.all());
  REQUIRE(first.exitCode == 0);
  const auto inputs = fluidtex::tools::Json::parse(readBytes(out / "run.json")).at("inputs");
  CHECK(inputs.size() == 8);
  const Words more = with(own, {"--resume", "--set", "frames=2"});
  const auto before = filesIn(out);
  const auto refused = [&](const char* name, const std::string& key, const auto& change) {
    const std::string bytes = readBytes(at(name));
    change();
    REQUIRE(readBytes(at(name)) != bytes);
    const Finished resumed = runProgram(more);
    INFO(name << ": " << resumed.all());
    CHECK(resumed.exitCode == 1);
    CHECK_THAT(resumed.err, Catch::Contains(key + ") has changed since the run began"));
    CHECK(filesIn(out) == before);
    std::ofstream(at(name), std::ios::binary) << bytes;
  };
  refused("exemplar.png", "exemplar.png (texture.exemplar",
          [&] { writeImage(at("exemplar.png"), 64, 3, 1.0); });
  refused("map.png", "map.png (texture.map.0.file", [&] { writeImage(at("map.png"), 64, 1, 1.0); });
  refused("guidance.png", "guidance.png (texture.guidance.map",
          [&] { writeImage(at("guidance.png"), 64, 1, 1.0); });
  refused("field.vdb", "field.vdb (texture.orientation.field", [&] { writeField(at("field.vdb"), 0.25f); });
  refused("ground.png", "ground.png (solid.2.height_field.file",
          [&] { writeImage(at("ground.png"), 16, 1, 1.0); });
  refused("block.obj", "block.obj (solid.0.mesh.file", [&] { writeBlock(at("block.obj"), 0.1); });
  refused("block2.obj", "block%d.obj (solid.1.mesh_sequence.files",
          [&] { writeBlock(at("block2.obj"), 0.35); });
  refused("onto1.obj", "onto%d.obj (texture.onto.files", [&] { writeBlock(at("onto1.obj"), 0.35); });

  // The same files elsewhere, younger; and of the meshes that are one a frame, one that was not in it yet.
  const fs::path moved = scratch.path / "moved";
  fs::create_directories(moved);
  for (const auto& entry : fs::directory_iterator(scratch.path))
    if (entry.is_regular_file()) fs::copy(entry.path(), moved / entry.path().filename());
  writeBlock(moved / "onto2.obj", 0.4);
  const Finished resumed =
      runProgram(with(with(run, settings(moved.string())), {"--resume", "--set", "frames=2"}));
  INFO(resumed.all());
  CHECK(resumed.exitCode == 0);
  CHECK_THAT(resumed.err, !Catch::Contains("frame 1/"));
}

TEST_CASE("fluidtex run --resume: maps of vectors go on as they were", "[tools]") {
  const Scratch scratch;
  const fs::path whole = scratch.path / "whole", out = scratch.path / "out";
  writeImage(scratch.path / "bump.png", 64, 3);
  const Words run{"run",
                  kSmallScene,
                  "--set",
                  "texture.map=[{ name = 'bump', holds = 'normals', file = '" +
                      (scratch.path / "bump.png").string() + "' }]",
                  "--set",
                  "render.bump={ map = 'bump' }"};
  REQUIRE(runProgram(with(run, {"--set", "frames=3", "--out", whole.string()})).exitCode == 0);
  REQUIRE(runProgram(with(run, {"--set", "frames=2", "--out", out.string()})).exitCode == 0);
  // The last frame's files are made from the state, vectors and all.
  fs::remove(out / "frames" / "0002.png");
  std::ofstream(out / "surface" / "0002.ply", std::ios::app) << "x";
  const Finished resumed = runProgram(with(run, {"--set", "frames=3", "--out", out.string(), "--resume"}));
  INFO(resumed.all());
  REQUIRE(resumed.exitCode == 0);
  CHECK(namesOf(resultsIn(out)) == namesOf(resultsIn(whole)));
  CHECK(differing(resultsIn(out), resultsIn(whole)).empty());
  CHECK((readBytes(out / "small.mp4") == readBytes(whole / "small.mp4")));
}

TEST_CASE("fluidtex run --resume: results that were damaged since are seen", "[tools]") {
  const Scratch scratch;
  const fs::path out = scratch.path / "out";
  const Words run{"run", kSmallScene, "--out", out.string(), "--set"},
      more = with(run, {"frames=3", "--resume"});
  REQUIRE(runProgram(with(run, {"frames=2"})).exitCode == 0);
  const auto refused = [&](const char* name, const std::string& bytes, const std::string& words) {
    const std::string whole = readBytes(out / name);
    if (bytes.empty())
      fs::remove(out / name);
    else
      std::ofstream(out / name, std::ios::binary) << bytes;
    const Finished resumed = runProgram(more);
    CHECK(resumed.exitCode == 1);
    CHECK_THAT(resumed.err, Catch::Contains("frames 1 to 2 are done, but " + std::string(name) + words));
    std::ofstream(out / name, std::ios::binary) << whole;
  };
  const std::string picture = readBytes(out / "frames" / "0001.png");
  refused("frames/0001.png", picture.substr(0, picture.size() / 2), " is not as the run wrote it");
  refused("surface/0001.ply", "x", " is not as the run wrote it");
  refused("surface/0001.ply", "", " is not there");

  // What is known of the frames before is lost.
  const std::string journal = readBytes(out / "state" / "journal.txt");
  std::ofstream(out / "state" / "journal.txt") << journal.substr(journal.find("{\"frame\":2"));
  const Finished lost = runProgram(more);
  CHECK(lost.exitCode != 0);
  std::ofstream(out / "state" / "journal.txt") << journal;

  // What fluidtex apply writes is as good.
  writeImage(scratch.path / "height.png", 64, 1);
  REQUIRE(runProgram({"apply", out.string(), "height=" + (scratch.path / "height.png").string()}).exitCode ==
          0);
  const Finished resumed = runProgram(more);
  INFO(resumed.all());
  CHECK(resumed.exitCode == 0);
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
