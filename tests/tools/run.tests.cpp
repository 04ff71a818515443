// Into what folder a run goes, and what it says, through the whole program.
#include "tools/run.h"

#include "tests/tools/program.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <fstream>

namespace fs = std::filesystem;

TEST_CASE("fluidtex run: a run over an earlier one leaves its own files and the user's", "[tools]") {
  const Scratch scratch;
  const fs::path out = scratch.path / "out";
  REQUIRE(runProgram({"run", kSmallScene, "--no-render", "--out", out.string()}).exitCode == 0);
  fs::create_directories(out / "frames");
  fs::create_directories(out / "state" / "mine");
  const std::vector<std::string> own = {"frames/12.png", "frames/note.txt", "other.mp4", "state/mine/x"};
  for (const std::string& name : own) std::ofstream(out / name) << "mine";
  for (const char* name : {".tmp-small.mp4", "frames/0030.png", "frames/0072.png", "frames/.tmp-0031.png"})
    std::ofstream(out / name) << "stale";
  REQUIRE(runProgram({"run", kSmallScene, "--frames", "1:1", "--out", out.string()}).exitCode == 0);
  std::vector<std::string> expected = {"exemplar.png",
                                       "frames/0001.png",
                                       "log.txt",
                                       "report.html",
                                       "run.json",
                                       "small.mp4",
                                       "state/0001/manifest.txt",
                                       "state/0001/run.json",
                                       "state/0001/solver.vdb",
                                       "state/0001/surface.bin",
                                       "state/journal.txt",
                                       "surface/0001.ply"};
  expected.insert(expected.end(), own.begin(), own.end());
  std::sort(expected.begin(), expected.end());
  CHECK(filesIn(out) == expected);
  CHECK(occurrences(readBytes(out / "log.txt"), "frames 1 to") == 1);
}

TEST_CASE("fluidtex run --no-render --quiet: surfaces only, and not a word", "[tools]") {
  const Scratch scratch;
  const fs::path out = scratch.path / "out";
  const Finished run =
      runProgram({"run", kSmallScene, "--no-render", "--quiet", "--frames", "1:2", "--out", out.string()});
  CHECK(run.exitCode == 0);
  CHECK(run.all().empty());
  CHECK(namesOf(resultsIn(out)) == std::vector<std::string>{"surface/0001.ply", "surface/0002.ply"});
  CHECK_FALSE(fs::exists(out / "small.mp4"));
}

TEST_CASE("fluidtex run: goes on where nothing can be printed, and the log is as ever", "[tools]") {
  const Scratch scratch;
  const auto onto = [](int stream, const char* file) { return [=] { dup2(open(file, O_WRONLY), stream); }; };
  const auto closed = [](int stream) { return [=] { close(stream); }; };
  const std::vector<std::function<void()>> streams = {onto(STDERR_FILENO, "/dev/full"), closed(STDERR_FILENO),
                                                      closed(STDOUT_FILENO), closed(STDIN_FILENO), [] {
                                                        for (int stream : {0, 1, 2}) close(stream);
                                                      }};
  for (std::size_t n = 0; n < streams.size(); ++n) {
    const fs::path out = scratch.path / std::to_string(n);
    INFO("case " << n);
    CHECK(
        runProgramWith(streams[n], {"run", kSmallScene, "--frames", "1:1", "--out", out.string()}).exitCode ==
        0);
    const std::string log = readBytes(out / "log.txt");
    CHECK(occurrences(log, "\n") ==
          5);  // the disk, how much of the exemplar fits, the run, its spacing, the frame
    CHECK(occurrences(log, "[info]") == 5);
    CHECK(fs::exists(out / "small.mp4"));
  }
  // A reader that goes away is no reason to stop either.
  const auto broken = [] {
    int ends[2];
    if (pipe(ends) != 0) _exit(126);
    close(ends[0]);
    dup2(ends[1], STDERR_FILENO);
  };
  CHECK(runProgramWith(broken, {"run", kSmallScene, "--frames", "1:1", "--no-render", "--out",
                                (scratch.path / "pipe").string()})
            .exitCode == 0);
}
