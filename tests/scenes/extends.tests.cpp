// A scene that is written over another.
#include "tests/scenes/scene_file.h"

#include <catch2/catch.hpp>

namespace fluidtex::scenes {
namespace {

std::vector<std::string> faultsOfFile(const std::filesystem::path& file,
                                      const std::filesystem::path& folder) {
  try {
    loadScene(file);
  } catch (const SceneError& error) {
    std::vector<std::string> faults = error.faults;
    const std::string prefix = folder.string() + "/";
    for (std::string& fault : faults)
      for (std::size_t at = fault.find(prefix); at != std::string::npos; at = fault.find(prefix))
        fault.erase(at, prefix.size());
    return faults;
  }
  return {};
}

}  // namespace

TEST_CASE("extends: keys replace those of the other scene, tables are merged, lists replaced", "[scenes]") {
  const SceneFolder folder;
  folder.write("base.toml",
               kGoodScene +
                   "[[solid]]\nsphere = { center = [1, 1, 1], radius = 0.1 }\n[[solid]]\nsphere = { "
                   "center = [1, 0, 1], radius = 0.1 }\n[render]\nsamples = 8\nbounces = 3\n"
                   "[quality.preview]\nrender.samples = 2\ndomain.resolution = 10\n");
  const auto file = folder.write(
      "child.toml",
      "extends = 'base.toml'\n[render]\nsamples = 32\n[[solid]]\nsphere = { center = [0, 0, 0], radius "
      "= 0.3 }\n[quality.preview]\ndomain.resolution = 12\n");
  const Scene scene = loadScene(file);
  CHECK(scene.name == "child");
  CHECK(scene.file == file);
  CHECK(scene.render.samples == 32);
  CHECK(scene.render.bounces == 3);
  REQUIRE(scene.sim.solids.size() == 1);
  CHECK(scene.sim.size == sim::Vec3d(2, 1, 1));
  Overrides preview;
  preview.quality = Quality::preview;
  CHECK(loadScene(file, preview).render.samples == 2);
  CHECK(loadScene(file, preview).sim.resolution == 12);
}

TEST_CASE("extends: the resolved scene is that of the same text in one file", "[scenes]") {
  const SceneFolder folder;
  folder.write("base.toml", "frames = 3\n" + kGoodScene);
  const auto whole = folder.write("s.toml", "render.samples = 5\nframes = 3\n" + kGoodScene);
  std::filesystem::create_directories(folder.path() / "below");
  const auto child = folder.write("below/s.toml", "extends = '../base.toml'\nrender.samples = 5\n");
  // The base's exemplar is beside the base.
  CHECK(loadScene(child).resolved == loadScene(whole).resolved);
}

TEST_CASE("extends: goes on over several files, and not in a circle", "[scenes]") {
  const SceneFolder folder;
  folder.write("a.toml", "frames = 3\nseed = 3\n" + kGoodScene);
  folder.write("b.toml", "extends = 'a.toml'\nframes = 4\n");
  const Scene scene = loadScene(folder.write("c.toml", "extends = 'b.toml'\nname = 'third'\n"));
  CHECK(scene.frames == 4);
  CHECK(scene.seed == 3);
  CHECK(scene.name == "third");
  folder.write("x.toml", "extends = 'y.toml'\n");
  const auto circle = faultsOfFile(folder.write("y.toml", "extends = 'x.toml'\n"), folder.path());
  REQUIRE(circle.size() == 1);
  CHECK(circle[0] ==
        "y.toml:1:1: error: extends: goes on for more than 8 files; extend a scene that does not "
        "come back to this one");
}

TEST_CASE("extends: faults stand where they were written", "[scenes]") {
  const SceneFolder folder;
  folder.write("base.toml", "texture.exemplar = 'e.png'\ndomain.size = [2, 1, 1]\nframes = 0\n");
  const auto file = folder.write("s.toml",
                                 "extends = 'base.toml'\nseed = -1\n[[liquid]]\nsphere = { center = "
                                 "[1, 0.5, 0.5], radius = 0.3 }\n");
  const std::vector<std::string> faults = faultsOfFile(file, folder.path());
  REQUIRE(faults.size() == 2);
  CHECK(faults[1] == "base.toml:3:1: error: frames: 0 is too small; give a whole number from 1 to 9999");
  CHECK_THAT(faults[0], Catch::StartsWith("s.toml:2:1: error: seed: "));

  CHECK(faultsOf("extends = 'none.toml'\n") ==
        std::vector<std::string>{
            "s.toml:1:1: error: extends: no such file: none.toml; give a scene file, relative "
            "to the folder of the one that extends it"});
  CHECK(faultsOf("extends = 3\n") ==
        std::vector<std::string>{
            "s.toml:1:1: error: extends: wrong type, a whole number where a string is wanted; "
            "give a scene file, for example extends = \"river.toml\""});
  folder.write("broken.toml", "frames = \n");
  const auto broken = faultsOfFile(folder.write("t.toml", "extends = 'broken.toml'\n"), folder.path());
  REQUIRE(!broken.empty());
  CHECK_THAT(broken[0], Catch::StartsWith("broken.toml:1:"));
}

}  // namespace fluidtex::scenes
