#include "tools/earlier_run.h"

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
  for (const char* name :
       {"frames/0030.png", "frames/0072.png", "frames/.tmp-0073.png", "surface/0072.ply", "surface/12345.ply",
        "state/0072/solver.vdb", "state/.tmp-0073/solver.vdb", "run.json", "dam.mp4", ".tmp-dam.mp4"})
    put(out / name);
  const std::vector<std::string> own = {"frames/0001.jpg", "frames/1.png", "other.mp4", "state/notes/0001"};
  for (const std::string& name : own) put(out / name);
  clearEarlierRun(out, "dam");
  CHECK(filesIn(out) == own);
  CHECK_FALSE(fs::exists(out / "surface"));
}

TEST_CASE("earlier run: the log is emptied, so that a logger that has it open goes on", "[tools]") {
  const Scratch scratch;
  std::ofstream log(scratch.path / "log.txt", std::ios::app);
  log << "old\n" << std::flush;
  clearEarlierRun(scratch.path, "dam");
  log << "new\n" << std::flush;
  CHECK(readBytes(scratch.path / "log.txt") == "new\n");
}

TEST_CASE("earlier run: the first result that is not there is named", "[tools]") {
  const Scratch scratch;
  CHECK(missingResult(scratch.path, 1, 0, true).empty());
  CHECK(missingResult(scratch.path, 2, 3, true) == "frames/0002.png");
  put(scratch.path / "surface" / "0002.ply");
  put(scratch.path / "surface" / "0003.ply");
  CHECK(missingResult(scratch.path, 2, 3, false).empty());
  CHECK(missingResult(scratch.path, 2, 4, false) == "surface/0004.ply");
  put(scratch.path / "frames" / "0002.png");
  CHECK(missingResult(scratch.path, 2, 3, true) == "frames/0003.png");
}
