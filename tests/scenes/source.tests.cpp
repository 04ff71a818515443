#include "scenes/source.h"

#include "tests/scenes/scene_file.h"

#include <catch2/catch.hpp>

namespace fluidtex::scenes {

TEST_CASE("source: text that was read already is the same scene as in a file", "[scenes]") {
  const SceneFolder folder;
  const std::filesystem::path file = folder.write("s.toml", "frames = 7\n" + kGoodScene);
  const Scene ofText = loadScene(Source{file, textOf(file)});
  CHECK(ofText.resolved == loadScene(file).resolved);
  CHECK(ofText.name == "s");
  // Nothing of that name has to be there; file names in it begin in its folder.
  const Scene unnamed = loadScene(Source{folder.path() / "stdin", textOf(file)});
  CHECK(unnamed.name == "stdin");
  CHECK(unnamed.texture.exemplar.file == folder.path() / "e.png");
  try {
    loadScene(Source{"stdin", "[domain]\nsise = [1, 1, 1]\n"});
    FAIL("a fault was not found");
  } catch (const SceneError& error) {
    CHECK_THAT(error.faults.front(), Catch::StartsWith("stdin:"));
  }
}

TEST_CASE("source: a later fault of a file is told where the scene names the file", "[scenes]") {
  const std::string scene =
      kGoodScene + "[[solid]]\nmesh = { file = 'm.obj' }\n[quality.preview]\ntexture.exemplar = 'f.png'\n";
  const Source source{"s.toml", scene};
  const Overrides plain;
  CHECK(faultLine(source, plain, "solid.0.mesh.file", "m.obj: is not closed") ==
        "s.toml:7:10: error: solid.0.mesh.file: m.obj: is not closed");
  CHECK(faultLine(source, plain, "texture.exemplar", "wrong") ==
        "s.toml:1:9: error: texture.exemplar: wrong");
  Overrides preview;
  preview.quality = Quality::preview;
  CHECK(faultLine(source, preview, "texture.exemplar", "wrong") ==
        "s.toml:9:9: error: quality.preview.texture.exemplar: wrong");
  Overrides set;
  set.set = {"solid.0.mesh.file=n.obj"};
  CHECK(faultLine(source, set, "solid.0.mesh.file", "wrong") ==
        "--set solid.0.mesh.file=n.obj: error: solid.0.mesh.file: wrong");
  Overrides given;
  given.exemplar = "other.jpg";
  CHECK(faultLine(source, given, "texture.exemplar", "wrong") ==
        "--exemplar other.jpg: error: texture.exemplar: wrong");
}

TEST_CASE("scene of a cache: named by what its files have in common", "[scenes]") {
  const auto nameOf = [](const char* cache) {
    Overrides liquid;
    liquid.liquidOnly = true;
    return sceneOfCache(cache, liquid).name;
  };
  CHECK(nameOf("/nowhere/water_####.vdb") == "water");
  CHECK(nameOf("/nowhere/cloud_%04d.vdb") == "cloud");
  CHECK(nameOf("/nowhere/pond.0007.vdb") == "pond");
  CHECK(nameOf("/nowhere/Netz 12.ply") == "Netz");
  CHECK(nameOf("/nowhere/0012.ply") == "cache");
}

}  // namespace fluidtex::scenes
