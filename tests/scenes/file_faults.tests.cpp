// Files that are no scene, and files with many faults.
#include "tests/scenes/fault_cases.h"

#include <catch2/catch.hpp>

namespace fluidtex::scenes {

TEST_CASE("scene faults: no TOML", "[scenes]") {
  const auto startsWith = [](const std::string& text, const std::string& start) {
    const std::vector<std::string> faults = faultsOf(text);
    INFO(text);
    REQUIRE(faults.size() == 1);
    CHECK_THAT(faults[0],
               Catch::StartsWith(start) && Catch::EndsWith("; write it as in https://toml.io/en/v1.0.0"));
  };
  startsWith("frames = 3\ndomain = [1, 2\n", "s.toml:2:16: error: syntax: ");
  startsWith("frames = \n", "s.toml:1:10: error: syntax: ");
  startsWith("frames 3\n", "s.toml:1:8: error: syntax: ");
  startsWith("frames = 3\nframes = 4\n", "s.toml:2:");
  startsWith("name = 'a\n", "s.toml:1:10: error: syntax: ");
  startsWith(std::string("name = '\xff\xfe'\n"), "s.toml:1:");
  startsWith("seed = 99999999999999999999\n", "s.toml:1:");
}

TEST_CASE("scene faults: every shorter version of a file is refused or read", "[scenes]") {
  const std::string text = kGoodScene + "[quality.preview]\n'domain.resolution' = 40\n";
  int refused = 0;
  for (std::size_t length = 0; length < text.size(); ++length) {
    const std::vector<std::string> faults = faultsOf(text.substr(0, length));
    refused += faults.empty() ? 0 : 1;
    for (const std::string& fault : faults)
      CHECK_THAT(fault, Catch::StartsWith("s.toml:") && Catch::Contains(": error: "));
  }
  CHECK(refused > int(kGoodScene.size()) - 3);
}

TEST_CASE("scene faults: the scene file itself", "[scenes]") {
  const SceneFolder folder;
  const auto faultOf = [&](const std::filesystem::path& file) {
    try {
      loadScene(file);
    } catch (const SceneError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string right = "; give a scene file, for example scenes/dam_break.toml";
  const std::string base = folder.path().string();
  CHECK(faultOf(folder.path() / "none.toml") == base + "/none.toml:1:1: error: file: no such file" + right);
  CHECK(faultOf(folder.path()) == base + ":1:1: error: file: is a folder" + right);
  CHECK(faultOf(folder.path() / "e.png" / "s.toml") ==
        base + "/e.png/s.toml:1:1: error: file: cannot be read: Not a directory" + right);
}

TEST_CASE("scene faults: all of a file, in the order of its lines", "[scenes]") {
  const std::string text =
      "frames = 0\n"
      "[texture]\n"
      "exemplar = 'none.png'\n"
      "windows = [8, 9]\n"
      "[render]\n"
      "sampels = 3\n"
      "samples = 'x'\n"
      "[[liquid]]\n"
      "velocity = [1, 2]\n"
      "[[liquid]]\n"
      "box = { min = [0, 0, 0], max = [1, 1, 0] }\n"
      "[quality.final]\n"
      "domain.resolution = 1\n"
      "[domain]\n"
      "size = [1, -1, 1]\n";
  Overrides overrides;
  overrides.set = {"camera.fov=0"};
  const std::vector<std::string> starts = {
      "s.toml:1:1: error: frames: ",
      "s.toml:3:1: error: texture.exemplar: ",
      "s.toml:4:1: error: texture.windows: 8 is even",
      "s.toml:4:1: error: texture.windows: 9 after 8",
      "s.toml:6:1: error: render.sampels: ",
      "s.toml:7:1: error: render.samples: ",
      "s.toml:8:1: error: liquid.0: no shape",
      "s.toml:9:1: error: liquid.0.velocity: ",
      "s.toml:11:26: error: liquid.1.box.max: ",
      "s.toml:13:8: error: quality.final.domain.resolution: ",
      "s.toml:15:1: error: domain.size: ",
      "--set camera.fov=0: error: camera.fov: ",
  };
  const std::vector<std::string> faults = faultsOf(text, overrides);
  REQUIRE(faults.size() == starts.size());
  for (std::size_t i = 0; i < starts.size(); ++i) CHECK_THAT(faults[i], Catch::StartsWith(starts[i]));
}

}  // namespace fluidtex::scenes
