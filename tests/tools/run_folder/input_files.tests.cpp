// fluidtex run --resume: goes on only with the files that it began with.
#include "tools/run_folder/input_files.h"

#include "scenes/scene.h"
#include "tests/tools/program.h"
#include "tests/tools/run_folder/inputs.h"
#include "tools/base/errors.h"
#include "tools/base/fingerprint.h"
#include "tools/run_folder/report.h"

#include <openvdb/openvdb.h>
#include <catch2/catch.hpp>

#include <chrono>
#include <fstream>
#include <variant>

namespace fs = std::filesystem;

namespace {

const fs::path kExemplars = FLUIDTEX_SOURCE "/scenes/exemplars";

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

// A scene with one file of each kind, in that folder.
fluidtex::scenes::Scene sceneIn(const fs::path& folder) {
  std::ofstream(folder / "exemplar.png") << "exemplar";
  std::ofstream(folder / "block.obj") << "block";
  for (int n = 3; n < 7; ++n) std::ofstream(folder / ("s_" + std::to_string(n) + ".obj")) << "number " << n;
  std::ofstream(folder / "s.toml") << "texture.exemplar = 'exemplar.png'\ndomain.size = [1, 1, 1]\n"
                                      "liquid = [{ box = { min = [0, 0, 0], max = [1, 1, 0.5] } }]\n"
                                      "[[solid]]\nmesh.file = 'block.obj'\n[[solid]]\n"
                                      "mesh_sequence = { files = 's_%d.obj', first = 3, last = 5 }\n";
  return fluidtex::scenes::loadScene(folder / "s.toml");
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
  const Words own = plus(run, settings(scratch.path.string()));
  const Finished first = runProgram(plus(own, {"--set", "frames=1"}));
  INFO(first.all());
  REQUIRE(first.exitCode == 0);
  const auto inputs = fluidtex::tools::Json::parse(readBytes(out / "run.json")).at("inputs");
  CHECK(inputs.size() == 8);
  const Words more = plus(own, {"--resume", "--set", "frames=2"});
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
      runProgram(plus(plus(run, settings(moved.string())), {"--resume", "--set", "frames=2"}));
  INFO(resumed.all());
  CHECK(resumed.exitCode == 0);
  CHECK_THAT(resumed.err, !Catch::Contains("frame 1/"));
}

TEST_CASE("input files: each by its key, with its content, and those of a sequence all in one", "[tools]") {
  using namespace fluidtex::tools;
  const Scratch scratch;
  const Json contents = contentsOf(sceneIn(scratch.path));
  std::vector<std::string> keys;
  for (const auto& [key, entry] : contents.items()) keys.push_back(key);
  CHECK(keys == Words{"solid.0.mesh.file", "solid.1.mesh_sequence.files", "texture.exemplar"});
  const Json& exemplar = contents["texture.exemplar"];
  CHECK(exemplar["file"] == (scratch.path / "exemplar.png").string());
  CHECK(exemplar["bytes"] == 8);
  CHECK(exemplar["hash"] == hashOf("exemplar"));
  CHECK_FALSE(exemplar.contains("first"));
  const Json& sequence = contents["solid.1.mesh_sequence.files"];
  CHECK(sequence["file"] == (scratch.path / "s_%d.obj").string());
  CHECK(sequence["first"] == 3);
  CHECK(sequence["count"] == 3);
  CHECK(sequence["bytes"] == 3 * 8);
  CHECK(sequence["hash"] == hashOf(hashOf("number 3") + hashOf("number 4") + hashOf("number 5")));
}

TEST_CASE("input files: only a content that has changed is a difference", "[tools]") {
  using namespace fluidtex::tools;
  const Scratch scratch, other;
  const fluidtex::scenes::Scene scene = sceneIn(scratch.path), moved = sceneIn(other.path);
  const Json before = contentsOf(scene);
  CHECK(contentDifference(before, contentsOf(scene), scene).empty());
  CHECK(contentDifference(before, contentsOf(moved), moved).empty());
  const auto changed = [&](const char* name, const std::string& content) {
    const std::string was = readBytes(scratch.path / name);
    std::ofstream(scratch.path / name) << content;
    const std::string told = contentDifference(before, contentsOf(scene), scene);
    std::ofstream(scratch.path / name) << was;
    return told;
  };
  CHECK(changed("exemplar.png", "examplar") ==
        (scratch.path / "exemplar.png").string() + " (texture.exemplar) has changed since the run began");
  CHECK(changed("s_4.obj", "number 5") ==
        (scratch.path / "s_%d.obj").string() +
            " (solid.1.mesh_sequence.files) has changed since the run began");
  CHECK(changed("exemplar.png", "exemplar").empty());
  // A key on one side only is the settings' difference.
  Json fewer = before;
  fewer.erase("texture.exemplar");
  CHECK(contentDifference(fewer, before, scene).empty());
  CHECK(contentDifference(before, fewer, scene).empty());
}

TEST_CASE("input files: a sequence may go on, with what there was as it was", "[tools]") {
  using namespace fluidtex::tools;
  const Scratch scratch;
  fluidtex::scenes::Scene scene = sceneIn(scratch.path);
  const Json before = contentsOf(scene);
  std::get<fluidtex::sim::MeshSequence>(scene.sim.solids[1].shape.kind).last = 6;
  CHECK(contentDifference(before, contentsOf(scene), scene).empty());
  std::ofstream(scratch.path / "s_6.obj") << "another";
  CHECK(contentDifference(before, contentsOf(scene), scene).empty());
  std::ofstream(scratch.path / "s_5.obj") << "another";
  CHECK_FALSE(contentDifference(before, contentsOf(scene), scene).empty());
}

TEST_CASE("input files: a picture more or another one is another exemplar that moves", "[tools]") {
  using namespace fluidtex::tools;
  const Scratch scratch;
  sceneIn(scratch.path);
  const auto scene = [&] {
    return fluidtex::scenes::loadScene(scratch.path / "s.toml",
                                       {.set = {"texture.exemplar=" + (scratch.path / "p_%d.png").string()}});
  };
  for (const char* name : {"p_2.png", "p_3.png"}) std::ofstream(scratch.path / name) << name;
  const Json before = contentsOf(scene());
  CHECK(before.at("texture.exemplar").at("first") == 2);
  CHECK(before.at("texture.exemplar").at("count") == 2);
  CHECK(contentDifference(before, contentsOf(scene()), scene()).empty());
  std::ofstream(scratch.path / "p_4.png") << "p_4.png";
  CHECK(contentDifference(before, contentsOf(scene()), scene()) ==
        (scratch.path / "p_%d.png").string() + " (texture.exemplar) has changed since the run began");
  fs::remove(scratch.path / "p_4.png");
  std::ofstream(scratch.path / "p_3.png") << "another";
  CHECK_FALSE(contentDifference(before, contentsOf(scene()), scene()).empty());
}

TEST_CASE("input files: of meshes that are one a frame, those there are", "[tools]") {
  using namespace fluidtex::tools;
  const Scratch scratch;
  fluidtex::scenes::Scene scene = sceneIn(scratch.path);
  scene.onto.files = scratch.path / "s_%d.obj";
  scene.onto.first = 4;
  const auto count = [&](int frames) {
    scene.frames = frames;
    return contentsOf(scene)["texture.onto.files"]["count"].get<int>();
  };
  CHECK(count(2) == 2);
  CHECK(count(3) == 3);
  CHECK(count(72) == 3);
}

TEST_CASE("input files: one that cannot be read is named", "[tools]") {
  using namespace fluidtex::tools;
  const Scratch scratch;
  const fluidtex::scenes::Scene scene = sceneIn(scratch.path);
  fs::remove(scratch.path / "s_4.obj");
  CHECK_THROWS_AS(contentsOf(scene), UsageError);
  CHECK_THROWS_WITH(contentsOf(scene), Catch::Contains("s_4.obj"));
}

TEST_CASE("input files: a cache is told apart by names, sizes and times, as far as it is used", "[tools]") {
  using namespace fluidtex::tools;
  const Scratch scratch;
  for (int n = 1; n < 4; ++n) std::ofstream(scratch.path / ("b_" + std::to_string(n) + ".obj")) << "block";
  fluidtex::scenes::Overrides overrides;
  overrides.liquidOnly = true;
  fluidtex::scenes::Scene scene = fluidtex::scenes::sceneOfCache(scratch.path, overrides);
  scene.frames = 2;
  const Json before = contentsOf(scene);
  CHECK(before["files.path"]["file"] == scratch.path.string());
  CHECK(before["files.path"]["frames"] == 2);
  CHECK(before["files.path"]["bytes"] == 10);
  const auto difference = [&] { return contentDifference(before, contentsOf(scene), scene); };
  const auto touch = [&](const char* name) {
    fs::last_write_time(scratch.path / name,
                        fs::last_write_time(scratch.path / name) + std::chrono::seconds(1));
  };
  CHECK(difference().empty());
  touch("b_3.obj");
  CHECK(difference().empty());
  scene.frames = 3;
  CHECK(difference().empty());
  touch("b_2.obj");
  CHECK(difference() == scratch.path.string() + " (files.path) has changed since the run began");
}
