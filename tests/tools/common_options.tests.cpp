#include "tools/common_options.h"

#include "tests/tools/command_line/asked.h"
#include "tools/base/errors.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <fstream>
#include <stdexcept>

namespace fs = std::filesystem;
using namespace fluidtex;
using namespace fluidtex::tools;
using Catch::Contains;
using Catch::EndsWith;
using Catch::StartsWith;

TEST_CASE("command line: a quality that changes nothing is told of", "[tools][command_line]") {
  const Finished plan = runProgram({"check", kSmallScene, "--quality", "preview"});
  CHECK(plan.exitCode == 0);
  CHECK_THAT(plan.err,
             StartsWith("warning: --quality preview: changes nothing") && Contains("texture.points=N"));
  CHECK(linesOf(plan.err) == 1);
  CHECK(runProgram({"check", kSmallScene, "--quality", "default"}).err.empty());
  CHECK(runProgram({"check", kSmallScene, "--quality", "preview", "--quiet"}).err.empty());
  CHECK(runProgram({"check", FLUIDTEX_SOURCE "/scenes/dam_break.toml", "--quality", "preview"}).err.empty());
}

TEST_CASE("command line: what does not fit is told at the scene's own line", "[tools][command_line]") {
  const Scratch scratch;
  const std::string good = "texture.exemplar = '" FLUIDTEX_SOURCE
                           "/scenes/exemplars/green_scales.png'\ndomain.size = [1, 1, 1]\n[[liquid]]\n"
                           "box = { min = [0, 0, 0], max = [1, 1, 0.3] }\n[[solid]]\n";
  std::ofstream(scratch.path / "open.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  std::ofstream(scratch.path / "bad_1.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  std::ofstream(scratch.path / "no picture.png") << "no picture";
  const auto told = [&](const std::string& scene, const std::vector<std::string>& more = {}) {
    const fs::path file = scratch.path / "s.toml";
    std::ofstream(file) << scene;
    const Finished run =
        runProgram(plus({"run", "s.toml", "--out", "out", "--frames", "1:1"}, more), scratch.path);
    INFO(run.all());
    CHECK(run.exitCode == 1);
    CHECK(linesOf(run.err) == 1);
    return run.err;
  };
  CHECK_THAT(told(good + "mesh = { file = 'open.obj' }\n"),
             StartsWith("s.toml:6:10: error: solid.0.mesh.file: open.obj: is not closed"));
  CHECK_THAT(told(good + "mesh_sequence = { files = 'bad_%d.obj', last = 1 }\n"),
             StartsWith("s.toml:6:19: error: solid.0.mesh_sequence.files: bad_1.obj: is not closed"));
  CHECK_THAT(told(good + "height_field = { file = 'no picture.png', pixel = 0.01 }\n"),
             StartsWith("s.toml:6:18: error: solid.0.height_field.file: no picture.png"));
  CHECK_THAT(told(good + "box = { min = [0.5, 0, 0], max = [0.6, 1, 1] }\n[[texture.map]]\nname = 'h'\n"
                         "file = 'no picture.png'\n"),
             StartsWith("s.toml:9:1: error: texture.map.0.file: no picture.png"));
  CHECK_THAT(
      told(good + "box = { min = [0.5, 0, 0], max = [0.6, 1, 1] }\n[texture.start]\nfile = 'open.obj'\n"),
      StartsWith("s.toml:8:1: error: texture.start.file: open.obj: no face has texture coordinates"));
  CHECK_THAT(
      told(good + "box = { min = [0.5, 0, 0], max = [0.6, 1, 1] }\n", {"--exemplar", "no picture.png"}),
      StartsWith("--exemplar no picture.png: error: texture.exemplar: no picture.png"));
}

TEST_CASE("common options: a range of frames is within the scene's, and lasts to its end unless it says",
          "[tools]") {
  scenes::Scene scene;
  scene.frames = 24;
  const auto range = [&](const std::string& text) {
    int first = 0, last = 0;
    parseFrames(text, scene, first, last);
    return std::pair{first, last};
  };
  CHECK(range("") == std::pair{1, 24});
  CHECK(range("3:7") == std::pair{3, 7});
  CHECK(range("3:") == std::pair{3, 24});
  CHECK(range("3") == std::pair{3, 3});
  CHECK(range("24:24") == std::pair{24, 24});
  for (const char* wrong : {"x", ":", ":5", "0:5", "-1:5", "1:2:3", "1:x", "1.5", " 1", "99999999999"}) {
    INFO(wrong);
    CHECK_THROWS_AS(range(wrong), UsageError);
    CHECK_THROWS_WITH(range(wrong), Contains("is no range of frames"));
  }
  CHECK_THROWS_WITH(range("7:3"), Contains("ends before it begins"));
  CHECK_THROWS_WITH(range("1:25"), Contains("the scene has 24 frames; --set frames=25 makes more"));
  CHECK_THROWS_WITH(range("25:"), Contains("ends before it begins"));
  scene.motion.flow = sim::MotionKind::files;
  scene.files.path = "balls";
  CHECK_THROWS_WITH(range("1:25"), Contains("the files of balls are of 24 frames; give 1:24 at most"));
}

TEST_CASE("common options: a cache is a folder, a pattern, or a file that is no scene", "[tools]") {
  const Scratch scratch;
  std::ofstream(scratch.path / "s.toml") << "x";
  std::ofstream(scratch.path / "water.vdb") << "x";
  fs::create_directory(scratch.path / "folder.toml");
  CHECK(isCache(scratch.path));
  CHECK(isCache(scratch.path / "folder.toml"));
  CHECK(isCache(scratch.path / "water.vdb"));
  CHECK(isCache(scratch.path / "none_####.vdb"));
  CHECK(isCache(scratch.path / "none_%04d.vdb"));
  CHECK_FALSE(isCache(scratch.path / "s.toml"));
  CHECK_FALSE(isCache(scratch.path / "none.toml"));
  CHECK_FALSE(isCache(scratch.path / "none.vdb"));
  CHECK_FALSE(isCache("-"));
}

TEST_CASE("common options: what the command line says of a scene and of joints", "[tools]") {
  CommonOptions options;
  options.set = {"frames=3"};
  options.exemplar = "e.png";
  for (const auto& [name, quality] :
       {std::pair{"preview", scenes::Quality::preview}, std::pair{"default", scenes::Quality::standard},
        std::pair{"final", scenes::Quality::final}}) {
    options.quality = name;
    CHECK(overridesOf(options).quality == quality);
  }
  CHECK(overridesOf(options).set == options.set);
  CHECK(overridesOf(options).exemplar == "e.png");
  CHECK_FALSE(overridesOf(options).liquidOnly);
  CHECK(overridesOf(options, true).liquidOnly);
  CHECK(jointsAs(options) == JointsAs::cut);
  options.joints = "blend";
  CHECK(jointsAs(options) == JointsAs::blend);
}

TEST_CASE("common options: those of a scene are those of a simulation and a folder and an exemplar more",
          "[tools]") {
  CommonOptions options;
  const std::vector<Option> less = simulationOptions(options), all = sceneOptions(options);
  const auto namesOf = [](const std::vector<Option>& some) {
    std::vector<std::string> names;
    for (const Option& option : some) names.push_back(option.name);
    return names;
  };
  std::vector<std::string> names = namesOf(less);
  CHECK(std::find(names.begin(), names.end(), "--exemplar") == names.end());
  CHECK(std::find(names.begin(), names.end(), "--out") == names.end());
  names.insert(names.end(), {"--out", "--exemplar"});
  CHECK(namesOf(all) == names);
  CHECK(namesOf(formatOptions(options)) == std::vector<std::string>{"--format", "--joints"});
}

TEST_CASE("common options: what is missing to load a scene is said before anything is read", "[tools]") {
  const Scratch scratch;
  CommonOptions options;
  options.quiet = true;
  options.scene = scratch.path / "water";
  CHECK_THROWS_AS(loadScene(options), UsageError);
  CHECK_THROWS_WITH(loadScene(options), EndsWith("water: there is no such scene file, and no such cache"));
  options.scene = scratch.path;
  CHECK_THROWS_AS(loadScene(options), UsageError);
  CHECK_THROWS_WITH(loadScene(options), Contains("give a picture, --exemplar IMAGE"));
  options.scene = kSmallScene;
  CHECK(loadScene(options).frames == 5);
  options.follow = true;
  CHECK_THROWS_AS(loadScene(options), UsageError);
  CHECK_THROWS_WITH(loadScene(options), StartsWith("--follow: "));
}

TEST_CASE("common options: only what begins with a file that the scene names is told at its line",
          "[tools]") {
  CommonOptions options;
  options.quiet = true;
  options.scene = kSmallScene;
  const scenes::Scene scene = loadScene(options);
  const auto told = [&](const std::string& message) -> std::string {
    try {
      atItsLine(options, scene, [&] { throw std::runtime_error(message); });
    } catch (const scenes::SceneError& error) {
      return error.what();
    } catch (const std::runtime_error& error) {
      CHECK(error.what() == message);
    }
    return {};
  };
  const std::string exemplar = scene.texture.exemplar.file.string();
  CHECK(told(exemplar + ": is torn: wholly") ==
        kSmallScene + ":17:1: error: texture.exemplar: " + exemplar + ": is torn: wholly");
  CHECK(told(exemplar + " cannot be read").ends_with(" cannot be read"));
  CHECK(told("other.png: is torn").empty());
  CHECK(told("it is torn: " + exemplar).empty());
  CHECK(told("").empty());
  bool done = false;
  atItsLine(options, scene, [&] { done = true; });
  CHECK(done);
}
