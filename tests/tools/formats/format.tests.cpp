#include "tools/formats/format.h"

#include "tools/base/errors.h"

#include <catch2/catch.hpp>

#include <set>

using namespace fluidtex;
using tools::Format;

TEST_CASE("formats: names, one or several, each once, and PLY is always among them", "[tools]") {
  CHECK(tools::parseFormats({}) == std::vector{Format::ply});
  CHECK(tools::parseFormats({"vtp", "glb", "vtp"}) == std::vector{Format::ply, Format::glb, Format::vtp});
  CHECK_THROWS_WITH(tools::parseFormats({"fbx"}), Catch::Contains("fbx") && Catch::Contains("give ply, glb"));
  CHECK_THROWS_AS(tools::parseFormats({""}), tools::UsageError);
  CHECK(tools::frameFile(Format::usda, 7) == "usd/0007.usda");
}

TEST_CASE("formats: each has its own name, folder and ending, in the order of their list", "[tools]") {
  const std::vector<Format> all = tools::parseFormats({"vtp", "usda", "obj", "glb"});
  REQUIRE(all.size() == std::size(tools::kFormatFiles));
  std::set<std::string> folders, endings;
  for (const Format format : all) {
    const tools::FormatFiles& files = tools::filesOf(format);
    CHECK(&files == &tools::kFormatFiles[std::size_t(format)]);
    CHECK(tools::parseFormats({files.name}).back() == format);
    CHECK(tools::frameFile(format, 12) == std::string(files.folder) + "/0012" + files.extension);
    folders.insert(files.folder);
    endings.insert(files.extension);
  }
  CHECK(folders.size() == all.size());
  CHECK(endings.size() == all.size());
  CHECK(tools::frameFile(Format::ply, 12345) == "surface/12345.ply");
  CHECK(tools::filesOf(Format::vtp).sequence == std::string(".pvd"));
  CHECK(tools::filesOf(Format::glb).sequence == nullptr);
}
