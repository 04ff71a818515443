#include "tools/run_folder/earlier_run.h"

#include "tests/scratch.h"

#include <catch2/catch.hpp>

using namespace fluidtex::tools;
namespace fs = std::filesystem;

namespace {

void put(const fs::path& file) {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << "x";
}

}  // namespace

TEST_CASE("earlier run: all that a run writes goes, whatever its frames, and nothing else", "[tools]") {
  const Scratch scratch;
  const fs::path out = scratch.path / "out";
  clearEarlierRun(out, "dam");
  CHECK(fs::is_directory(out));
  for (const char* name : {"frames/0030.png",
                           "frames/0072.png",
                           "frames/.tmp-0073.png",
                           "surface/0072.ply",
                           "surface/12345.ply",
                           "state/0072/solver.vdb",
                           "state/.tmp-0073/solver.vdb",
                           "run.json",
                           "report.html",
                           "dam.mp4",
                           ".tmp-dam.mp4",
                           "glb/0072.glb",
                           "obj/0072.obj",
                           "obj/surface.mtl",
                           "usd/0072.usda",
                           "vtp/.tmp-0073.vtp",
                           "dam.usda",
                           "dam.pvd",
                           "exemplar.png",
                           "between.png"})
    put(out / name);
  const std::vector<std::string> own = {"frames/0001.jpg", "frames/1.png", "glb/mine.glb",
                                        "other.mp4",       "other.usda",   "state/notes/0001"};
  for (const std::string& name : own) put(out / name);
  clearEarlierRun(out, "dam");
  CHECK(filesIn(out) == own);
  CHECK_FALSE(fs::exists(out / "surface"));
  CHECK_FALSE(fs::exists(out / "vtp"));
}

TEST_CASE("earlier run: the log is emptied, so that a logger that has it open goes on", "[tools]") {
  const Scratch scratch;
  std::ofstream log(scratch.path / "log.txt", std::ios::app);
  log << "old\n" << std::flush;
  clearEarlierRun(scratch.path, "dam");
  log << "new\n" << std::flush;
  CHECK(readBytes(scratch.path / "log.txt") == "new\n");
}

TEST_CASE("earlier run: the first result that is not as it was written is named", "[tools]") {
  const Scratch scratch;
  const auto broken = [&](int first, int last, bool rendered) {
    return firstBroken(scratch.path, readJournal(scratch.path), first, last, {.picture = rendered});
  };
  const auto written = [&](const std::string& name) {
    put(scratch.path / name);
    addToJournal(scratch.path, {lineOfFile(name, fingerprintOf(scratch.path / name))});
  };
  CHECK_FALSE(broken(1, 0, true));
  REQUIRE(broken(2, 3, true));
  CHECK(broken(2, 3, true)->name == "frames/0002.png");
  CHECK_FALSE(broken(2, 3, true)->written);
  written("surface/0002.ply");
  written("surface/0003.ply");
  CHECK_FALSE(broken(2, 3, false));
  CHECK(broken(2, 4, false)->name == "surface/0004.ply");
  written("frames/0002.png");
  CHECK(broken(2, 3, true)->name == "frames/0003.png");
  std::ofstream(scratch.path / "surface" / "0002.ply") << "other";
  CHECK(broken(2, 3, false)->name == "surface/0002.ply");
  CHECK((broken(2, 3, false)->there && broken(2, 3, false)->written));
  // Nobody has said that this one is as it should be.
  put(scratch.path / "surface" / "0004.ply");
  CHECK((broken(4, 4, false)->there && !broken(4, 4, false)->written));
}
