#include "tools/frames/image_notes.h"

#include <catch2/catch.hpp>

#include <filesystem>

using namespace fluidtex;

TEST_CASE("image notes: the exemplar and a finer picture, if there is one", "[tools]") {
  texture::ExemplarOptions options;
  options.file = "a.png";
  CHECK(tools::colorPictures(options) == std::vector<std::filesystem::path>{"a.png"});
  options.betweenFile = "fine.png";
  CHECK(tools::colorPictures(options) == std::vector<std::filesystem::path>{"a.png", "fine.png"});
}

TEST_CASE("image notes: a file that cannot be read is told when it is read, not here", "[tools]") {
  CHECK(tools::imageNotes({"/nowhere/a.png"}).empty());
}
