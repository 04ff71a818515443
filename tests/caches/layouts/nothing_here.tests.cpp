#include "caches/layouts/nothing_here.h"

#include "caches/layouts/layout.h"
#include "tests/caches/layouts/folder_files.h"

using namespace fluidtex::caches;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

std::string refused(const fs::path& folder) {
  Options options;
  options.path = folder;
  return refusal([&] { recognize(options); });
}

}  // namespace

TEST_CASE("nothing_here: folders of caches are named, a few of them", "[caches]") {
  const Scratch scratch;
  writeFile(scratch.path / "notes.txt");
  writeFile(scratch.path / "empty" / "notes.txt");
  CHECK_THAT(refused(scratch.path), Contains("holds nothing that can be read as a liquid"));
  writeFile(scratch.path / "splash" / "config" / "config_0001.uni");
  CHECK_THAT(refused(scratch.path),
             Contains("(splash); give one of them, as") && Contains((scratch.path / "splash").string()));
  writeFile(scratch.path / "pour" / "bakefiles" / "000001.bobj");
  writeFile(scratch.path / "balls" / "ball_1.ply", plyBytes(true));
  CHECK_THAT(refused(scratch.path), Contains("(balls, pour, splash);"));
  writeFile(scratch.path / "waves" / "w1.vdb");
  CHECK_THAT(refused(scratch.path), Contains("(balls, pour, splash and others);"));
}

TEST_CASE("nothing_here: a folder of files that are not read gets what one of them gets", "[caches]") {
  const Scratch scratch;
  for (const char* name : {"w_0001.abc", "w_0002.abc", "w_0003.abc"}) writeFile(scratch.path / name);
  const std::string file = (scratch.path / "w_0001.abc").string();
  CHECK_THAT(refused(scratch.path), StartsWith(file + ": is an Alembic archive, which is not read"));
  writeFile(scratch.path / "vdb" / "w1.vdb");
  CHECK_THAT(refused(scratch.path), Contains("(vdb); give one of them"));
}
