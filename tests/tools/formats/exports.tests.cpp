#include "tools/formats/exports.h"

#include "tests/scratch.h"
#include "tests/tools/formats/sample_surface.h"
#include "tools/formats/exemplar_picture.h"

#include <catch2/catch.hpp>

using namespace fluidtex;
namespace fs = std::filesystem;

TEST_CASE("exports: each format has its folder, and lists of a sequence name the files that are there",
          "[tools]") {
  const Scratch scratch;
  tools::Exports exports{tools::parseFormats({"glb", "obj", "usda", "vtp"}), tools::JointsAs::cut, {}};
  exports.appearance.name = "a b";
  exports.appearance.picture = tools::kExemplarFile;
  tools::writeExports({}, 1, 0.0, exports, scratch.path);
  tools::writeExports(sampleSurface(), 3, 0.1, exports, scratch.path);
  tools::updateSequences(exports, scratch.path);
  CHECK(filesIn(scratch.path) == std::vector<std::string>{"a b.pvd", "a b.usda", "glb/0001.glb",
                                                          "glb/0003.glb", "obj/0001.obj", "obj/0003.obj",
                                                          "obj/surface.mtl", "usd/0001.usda", "usd/0003.usda",
                                                          "vtp/0001.vtp", "vtp/0003.vtp"});
  const std::string pvd = readBytes(scratch.path / "a b.pvd"), stage = readBytes(scratch.path / "a b.usda");
  CHECK(pvd.find("vtp/0001.vtp") != std::string::npos);
  CHECK(pvd.find("vtp/0002.vtp") == std::string::npos);
  // What there is is said by a frame that has a surface.
  CHECK(stage.find("references = @./usd/0003.usda@") != std::string::npos);
  CHECK(stage.find("assetPaths = [@./usd/0001.usda@, @./usd/0003.usda@]") != std::string::npos);
}

TEST_CASE("exports: the same surface gives the same bytes", "[tools]") {
  const Scratch scratch;
  const tools::Exports exports{
      tools::parseFormats({"glb", "obj", "usda", "vtp"}), tools::JointsAs::blend, {}};
  for (const char* folder : {"a", "b"})
    tools::writeExports(sampleSurface(), 1, 0.0, exports, scratch.path / folder);
  for (const std::string& name : filesIn(scratch.path / "a"))
    CHECK(readBytes(scratch.path / "a" / name) == readBytes(scratch.path / "b" / name));
}
