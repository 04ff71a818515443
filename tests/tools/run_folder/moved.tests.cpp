// A run's folder that was moved, away from the exemplar too.
#include "tests/tools/program.h"

#include <catch2/catch.hpp>

namespace fs = std::filesystem;

namespace {

// All that the file tells of as text.
bool names(const fs::path& file, const std::string& text) {
  return readBytes(file).find(text) != std::string::npos;
}

}  // namespace

TEST_CASE("moved run: no file but run.json, its copy in state/ and the log tells where it was made",
          "[tools]") {
  const Scratch scratch;
  const fs::path made = scratch.path / "made here, & there", moved = scratch.path / "moved",
                 exemplar = scratch.path / "picture.png";
  fs::copy_file(FLUIDTEX_SOURCE "/scenes/exemplars/green_scales.png", exemplar);
  const std::vector<std::string> scene{kSmallScene, "--exemplar", exemplar.string(), "--set",
                                       "texture.toroidal=true"};
  const auto run = [&](std::vector<std::string> words, const std::vector<std::string>& more) {
    words.insert(words.begin() + 1, scene.begin(), scene.end());
    const Finished done = runProgram(plus(words, more));
    INFO(done.all());
    REQUIRE(done.exitCode == 0);
  };
  run({"run"}, {"--frames", "1:2", "--no-render", "--format", "glb,obj,usda,vtp", "--out", made.string()});
  fs::rename(made, moved);
  for (const std::string& name : filesIn(moved)) {
    INFO(name);
    if (name == "run.json" || name == "log.txt" || name.ends_with("/run.json") || name == "report.html")
      continue;
    CHECK_FALSE(names(moved / name, made.filename().string()));
    CHECK_FALSE(names(moved / name, scratch.path.string()));
  }

  // It goes on there, also from pictures that lie elsewhere now.
  const fs::path elsewhere = scratch.path / "elsewhere.png";
  fs::rename(exemplar, elsewhere);
  const auto plain = [&](const std::vector<std::string>& words) {
    const Finished done = runProgram(words);
    INFO(done.all());
    CHECK(done.exitCode == 0);
  };
  plain({"measure", moved.string(), "--quiet"});
  plain({"apply", moved.string(), "height=" + elsewhere.string()});
  const std::string before = readBytes(moved / "glb" / "0002.glb");
  plain({"export", moved.string(), "--format", "glb", "--quiet"});
  CHECK(names(moved / "glb" / "0002.glb", "_HEIGHT"));
  CHECK(before.find("_HEIGHT") == std::string::npos);
  plain({"render", kSmallScene, "--exemplar", elsewhere.string(), "--set", "texture.toroidal=true",
         "--frames", "2", "--from", moved.string(), "--out", (scratch.path / "rendered").string(), "--set",
         "texture.between=exemplar"});
  plain({"run", kSmallScene, "--exemplar", elsewhere.string(), "--set", "texture.toroidal=true",
         "--no-render", "--resume", "--frames", "1:3", "--format", "vtp", "--out", moved.string()});
  CHECK(names(moved / "small.pvd", "vtp/0003.vtp"));
  CHECK(fs::exists(moved / "glb" / "0001.glb"));
}

TEST_CASE("formats: one that is not known is refused before anything is done", "[tools]") {
  const Scratch scratch;
  const Finished done =
      runProgram({"run", kSmallScene, "--format", "fbx", "--out", (scratch.path / "out").string()});
  CHECK(done.exitCode == 1);
  CHECK_THAT(done.err, Catch::Contains("--format fbx: is not known"));
  CHECK_FALSE(fs::exists(scratch.path / "out"));
}
