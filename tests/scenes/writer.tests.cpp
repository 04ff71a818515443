#include "scenes/writer.h"

#include "tests/scenes/full_scene.h"

#include <catch2/catch.hpp>

#include <limits>
#include <utility>

namespace fluidtex::scenes {

TEST_CASE("scene: the resolved scene has every key, given or not", "[scenes]") {
  const std::string ball = "sphere = { center = [1, 1, 1], radius = 0.5 }\n";
  const std::string oneEach =
      "[heat]\nlaw = 'table'\npoint = [ { temperature = 1, viscosity = 1 }, { temperature = 2, viscosity = 1 "
      "} "
      "]\n"
      "[[solid]]\nmesh = { file = 'm.obj' }\nkeyframe = [ { time = 1 } ]\n[[solid]]\nmesh_sequence = { files "
      "= "
      "'m_%d.obj', last = 2 }\n[[source]]\n" +
      ball + "rate = [ { time = 0, factor = 1 } ]\n[[drain]]\n" + ball +
      "[[wall]]\n[texture.scale]\npoint = [ { value = 0, factor = 1 } ]\n"
      "[texture.renewal]\npoint = [ { value = 0, factor = 1 } ]\n"
      "[texture.guidance]\npoint = [ { value = 0, level = 1 } ]\n"
      "[[texture.map]]\nname = 'height'\nfile = 'e.png'\n";
  std::set<std::string> whole, defaults;
  collectKeys(Json::parse(sceneOf(kFullScene).resolved), "", whole);
  collectKeys(Json::parse(sceneOf(kGoodScene + oneEach).resolved), "", defaults);
  CHECK(whole.size() > 60);
  for (const std::string& key : whole) {
    INFO(key);
    const bool shape = key.find("union") != std::string::npos || key.find("sphere") != std::string::npos ||
                       key.find("cylinder") != std::string::npos ||
                       key.find("height_field") != std::string::npos;
    CHECK((shape || defaults.contains(key)));
  }
  for (const std::string& key : defaults) {
    INFO(key);
    CHECK((whole.contains(key) || key.find("sphere") != std::string::npos));
  }
}

TEST_CASE("scene: the resolved scene holds the values that are used", "[scenes]") {
  const Json full = Json::parse(sceneOf(kFullScene).resolved);
  CHECK(full["quality"] == "default");
  CHECK(full["domain"]["resolution"] == 48);
  CHECK(full["fluid"]["gravity"] == Json::array({1.0, 0.0, -3.0}));
  CHECK(full["liquid"][1]["union"][1]["difference"][1]["mesh"]["scale"] == 2.0);
  CHECK(full["solid"][0]["until"] == 0.75);
  CHECK(full["solid"][1]["until"].is_null());
  CHECK(full["texture"]["method"] == "kwatra07");
  CHECK(full["texture"]["points"] == 1234);
  CHECK(full["texture"]["spacing"].is_null());
  CHECK(full["render"]["size"] == Json::array({320, 180}));

  const Json spaced = Json::parse(sceneOf("texture.spacing = 0.1\n" + kGoodScene).resolved);
  CHECK(spaced["texture"]["spacing"] == 0.1);
  CHECK(spaced["texture"]["points"].is_null());
}

TEST_CASE("scene: the resolved scene says the same when it is read twice", "[scenes]") {
  const SceneFolder folder;
  const std::filesystem::path file = folder.write("s.toml", kFullScene);
  CHECK(loadScene(file).resolved == loadScene(file).resolved);
}

TEST_CASE("scene: the resolved scene is the same wherever the file is named from", "[scenes]") {
  const SceneFolder folder;
  const std::filesystem::path file = folder.write("s.toml", kFullScene),
                              before = std::filesystem::current_path();
  const std::string resolved = loadScene(file).resolved;
  std::filesystem::current_path(folder.path() / "pictures");
  Overrides exemplar;
  exemplar.exemplar = "../e.png";
  // Guidance, maps and their relief are of the scene's own exemplar, and left out with another.
  exemplar.set = {"texture.toroidal=true",
                  "texture.between=file",
                  "texture.between_file=../e.png",
                  "texture.guidance.by=field",
                  "texture.map=[{ name = 'height', file = '../e.png', holds = 'normals' }, "
                  "{ name = 'bumps', file = '../e.png', weight = 0.5 }]",
                  "render.bump.height=2.5",
                  "render.displacement.height=1.5",
                  "render.material.glow=2"};
  const std::string relative = loadScene("../s.toml").resolved,
                    chosen = loadScene("../s.toml", exemplar).resolved;
  std::filesystem::current_path(before);
  CHECK(relative == resolved);
  CHECK(chosen == resolved);
}

TEST_CASE("writer: the quality comes first, then the keys in the order of the schema", "[scenes]") {
  Scene scene;
  scene.name = "pond";
  for (const auto& [quality, name] :
       {std::pair{Quality::preview, "preview"}, std::pair{Quality::standard, "default"},
        std::pair{Quality::final, "final"}}) {
    const std::string text = resolvedText(scene, quality);
    CHECK_THAT(text, Catch::StartsWith("{\n  \"quality\": \"" + std::string(name) +
                                       "\",\n  \"name\": \"pond\",\n  \"frames\": 72,"));
  }
  const std::string text = resolvedText(scene, Quality::standard);
  CHECK(text.find("\n  \"domain\"") < text.find("\n  \"texture\""));
  CHECK(text.find("\n  \"texture\"") < text.find("\n  \"camera\""));
}

TEST_CASE("writer: what is not finite or not there is null", "[scenes]") {
  Scene scene;
  scene.sim.solids.resize(2);
  scene.sim.solids[1].until = 2.5;
  scene.render.camera.at = sim::Vec3d(std::numeric_limits<double>::quiet_NaN());
  const Json written = Json::parse(resolvedText(scene, Quality::standard));
  CHECK(written["solid"][0]["until"].is_null());
  CHECK(written["solid"][1]["until"] == 2.5);
  CHECK(written["camera"]["at"] == Json::array({nullptr, nullptr, nullptr}));
  CHECK(written["texture"]["exemplar"].is_null());
  CHECK(written["texture"]["guidance"]["map"].is_null());
  CHECK(written["drain"] == Json::array());
}

TEST_CASE("writer: whole numbers of any size and doubles come back as they were", "[scenes]") {
  Scene scene;
  scene.seed = std::numeric_limits<std::uint64_t>::max();
  scene.sim.density = 0.1 + 0.2;
  const Json written = Json::parse(resolvedText(scene, Quality::standard));
  CHECK(written["seed"].get<std::uint64_t>() == scene.seed);
  CHECK(written["fluid"]["density"].get<double>() == scene.sim.density);
}

TEST_CASE("writer: files are told by their whole place, in bytes that any reader takes", "[scenes]") {
  Scene scene;
  scene.texture.exemplar.file = "pictures/../\xff.png";
  const Json written = Json::parse(resolvedText(scene, Quality::standard));
  CHECK(written["texture"]["exemplar"] ==
        (std::filesystem::current_path() / "\xef\xbf\xbd.png").generic_string());
}

}  // namespace fluidtex::scenes
