// One writer a folder, and nothing outside it.
#include "tools/run_folder/out_folder.h"

#include "tests/tools/program.h"
#include "tools/base/errors.h"

#include <catch2/catch.hpp>

#include <csignal>
#include <fstream>

using namespace fluidtex::tools;
namespace fs = std::filesystem;

TEST_CASE("out folder: one holds it, and lets go of it with all that was there for that", "[tools]") {
  const Scratch scratch;
  const fs::path out = scratch.path / "a" / "out";
  {
    const OutFolder folder(out);
    CHECK_THROWS_WITH(OutFolder(out),
                      Catch::Contains(out.string() + ": process " + std::to_string(getpid())));
  }
  CHECK(fs::is_empty(out));
  const OutFolder again(out);
}

TEST_CASE("out folder: several hold it together, beside none that holds it alone", "[tools]") {
  const Scratch scratch;
  const fs::path& out = scratch.path;
  {
    const OutFolder first(out, Holding::together);
    { const OutFolder second(out, Holding::together); }
    CHECK_THROWS_AS(OutFolder(out), UsageError);  // the first still holds it
    const OutFolder third(out, Holding::together);
  }
  CHECK(fs::is_empty(out));
  const OutFolder alone(out);
  CHECK_THROWS_AS(OutFolder(out, Holding::together), UsageError);
}

TEST_CASE("out folder: what a killed process left is in nobody's way", "[tools]") {
  const Scratch scratch;
  std::ofstream(scratch.path / ".fluidtex-lock") << "1\n";
  const OutFolder folder(scratch.path);
  CHECK_THROWS_AS(OutFolder(scratch.path), UsageError);
}

TEST_CASE("out folder: links out of it are refused, the folder itself may be one", "[tools]") {
  const Scratch scratch;
  fs::create_directories(scratch.path / "real");
  fs::create_directory_symlink(scratch.path / "real", scratch.path / "out");
  OutFolder(scratch.path / "out");
  for (const char* name : {"frames", "surface", "onto", "state", "log.txt", ".fluidtex-lock"}) {
    const fs::path link = scratch.path / "real" / name;
    fs::create_symlink(scratch.path / "elsewhere", link);
    CHECK_THROWS_AS(OutFolder(scratch.path / "out"), UsageError);
    fs::remove(link);
  }
  OutFolder(scratch.path / "out");
  std::ofstream(scratch.path / "file") << "x";
  CHECK_THROWS_WITH(OutFolder(scratch.path / "file"), Catch::Contains("is no folder"));
}

TEST_CASE("fluidtex run: nothing outside the folder is written or removed", "[tools]") {
  const Scratch scratch;
  const fs::path out = scratch.path / "out", mine = scratch.path / "mine";
  fs::create_directories(out);
  fs::create_directories(mine);
  const std::vector<std::string> args{"run", kSmallScene, "--frames", "1:1", "--out", out.string()};
  const auto refused = [&](const std::string& name) {
    const Finished run = runProgram(args);
    CHECK(run.exitCode == 1);
    CHECK_THAT(run.err, Catch::Contains((out / name).string() + ": is a link"));
    fs::remove(out / name);
  };
  std::ofstream(mine / "0001.png") << "mine";
  fs::create_directory_symlink(mine, out / "frames");
  refused("frames");
  fs::create_symlink(mine / "0001.png", out / "log.txt");
  refused("log.txt");
  // Names that are replaced: the link goes, what it leads to stays.
  fs::create_directories(out / "surface");
  for (const char* name : {"run.json", ".tmp-run.json", "surface/0001.ply", "small.mp4"})
    fs::create_symlink(mine / "0001.png", out / name);
  REQUIRE(runProgram(args).exitCode == 0);
  CHECK(readBytes(mine / "0001.png") == "mine");
  CHECK(filesIn(mine) == std::vector<std::string>{"0001.png"});
  CHECK_FALSE(fs::is_symlink(out / "surface" / "0001.ply"));
}

TEST_CASE("fluidtex: two into one folder, the second is refused and the first goes on", "[tools]") {
  const Scratch scratch;
  const fs::path out = scratch.path / "out";
  const std::vector<std::string> run{"run",        kSmallScene, "--no-render", "--set",
                                     "frames=500", "--out",     out.string()};
  const RunningProgram first(run);
  first.waitForLines(out / "state" / "journal.txt", 0, 2);  // a surface and its frame
  const std::string log = readBytes(out / "log.txt");
  std::vector<std::string> resume = run;
  resume.emplace_back("--resume");
  for (const std::vector<std::string>& args :
       {run,
        resume,
        {"measure", out.string()},
        {"apply", out.string(), "height=x.png"},
        {"render", kSmallScene, "--frames", "1:1", "--from", out.string(), "--out", out.string()}}) {
    const Finished second = runProgram(args);
    INFO(args[0] << ": " << second.all());
    CHECK(second.exitCode == 1);
    CHECK_THAT(second.err, Catch::Contains(out.string() + ": process " + std::to_string(first.id()) +
                                           " is writing into this"));
  }
  CHECK_THAT(readBytes(out / "log.txt"), Catch::StartsWith(log));
  first.signal(SIGKILL);
  CHECK(first.wait().exitCode == -1);
  resume[4] = "frames=2";
  resume.push_back("--frames");
  resume.push_back("1:2");
  const Finished after = runProgram(resume);
  INFO(after.all());
  CHECK(after.exitCode == 0);
  CHECK_FALSE(fs::exists(out / ".fluidtex-lock"));
}
