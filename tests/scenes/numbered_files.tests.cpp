#include "scenes/numbered_files.h"

#include "tests/scenes/scene_file.h"

#include <catch2/catch.hpp>

namespace fluidtex::scenes {
namespace {

std::vector<std::string> namesOf(const NumberedFiles& found) {
  std::vector<std::string> names;
  for (const std::filesystem::path& file : found.files) names.push_back(file.filename().string());
  return names;
}

}  // namespace

TEST_CASE("numbered files: from the lowest number on, until one is missing", "[scenes]") {
  const SceneFolder folder;
  for (const char* name : {"a_0007.png", "a_0008.png", "a_0010.png", "a_9.png", "a_0009.jpg", "b_0009.png"})
    folder.write(name, "");
  const NumberedFiles four = numberedFiles(folder.path() / "a_%04d.png");
  CHECK(four.first == 7);
  CHECK(namesOf(four) == std::vector<std::string>{"a_0007.png", "a_0008.png"});
  CHECK(four.missing.filename() == "a_0009.png");
  // Without padding another file is number 9, and the others are none.
  const NumberedFiles any = numberedFiles(folder.path() / "a_%d.png");
  CHECK(any.first == 9);
  CHECK(namesOf(any) == std::vector<std::string>{"a_9.png"});
  CHECK(any.missing.empty());
  CHECK(firstOf(folder.path() / "a_%04d.png").filename() == "a_0007.png");
  CHECK(firstOf(folder.path() / "c_%04d.png").filename() == "c_%04d.png");
  CHECK(firstOf("100%.png") == "100%.png");
}

TEST_CASE("numbered files: none where nothing fits, or the folder is not there", "[scenes]") {
  const SceneFolder folder;
  CHECK(numberedFiles(folder.path() / "c_%d.png").files.empty());
  CHECK(numberedFiles(folder.path() / "nowhere" / "c_%d.png").files.empty());
}

}  // namespace fluidtex::scenes
