#include "tools/base/atomic_file.h"

#include "tests/scratch.h"

#include <catch2/catch.hpp>

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <iterator>

using namespace fluidtex::tools;
namespace fs = std::filesystem;

TEST_CASE("writeAtomically: the file appears whole, in folders that are made, and nothing else is left",
          "[tools]") {
  const Scratch scratch;
  const fs::path file = scratch.path / "a" / "b" / "text.txt";
  writeTextAtomically(file, "one");
  writeTextAtomically(file, "two");
  CHECK(readBytes(file) == "two");
  CHECK(filesIn(scratch.path) == std::vector<std::string>{"a/b/text.txt"});
}

TEST_CASE("writeAtomically: a writer that throws leaves the old file and no temporary one", "[tools]") {
  const Scratch scratch;
  const fs::path file = scratch.path / "text.txt";
  writeTextAtomically(file, "old");
  CHECK_THROWS_AS(writeAtomically(file,
                                  [](const fs::path& temporary) {
                                    CHECK(temporary.extension() == ".txt");
                                    std::ofstream(temporary) << "half";
                                    throw std::runtime_error("disk full");
                                  }),
                  std::runtime_error);
  CHECK(readBytes(file) == "old");
  CHECK(filesIn(scratch.path) == std::vector<std::string>{"text.txt"});
}

TEST_CASE("writeFolderAtomically: replaces a folder as a whole", "[tools]") {
  const Scratch scratch;
  const fs::path folder = scratch.path / "state";
  writeFolderAtomically(folder, [](const fs::path& f) { std::ofstream(f / "first") << "1"; });
  writeFolderAtomically(folder, [](const fs::path& f) { std::ofstream(f / "second") << "2"; });
  CHECK(filesIn(scratch.path) == std::vector<std::string>{"state/second"});
  CHECK_THROWS(writeFolderAtomically(folder, [](const fs::path&) { throw std::runtime_error("disk full"); }));
  CHECK(filesIn(scratch.path) == std::vector<std::string>{"state/second"});
}

namespace {

// A process that writes a file in three parts: `half`, what `between` does, and the rest.
template <typename Between>
pid_t writer(const fs::path& file, const Between& between) {
  const pid_t child = fork();
  if (child != 0) return child;
  writeAtomically(file, [&](const fs::path& temporary) {
    std::ofstream(temporary) << "half" << std::flush;
    between();
    std::ofstream(temporary, std::ios::app) << " and half" << std::flush;
  });
  _exit(0);
}

void killedWriter(const fs::path& file) {
  const pid_t child = writer(file, [] { raise(SIGKILL); });
  waitpid(child, nullptr, 0);
}

}  // namespace

TEST_CASE("writeAtomically: what a killed process has left goes with the next that writes there", "[tools]") {
  const Scratch scratch;
  const fs::path file = scratch.path / "a" / "0001.png";
  for (int kill = 0; kill < 3; ++kill) {
    killedWriter(file);
    // Not more than one, however often.
    REQUIRE(filesIn(scratch.path).size() == 1);
    CHECK(filesIn(scratch.path)[0].starts_with("a/.tmp-"));
  }
  killedWriter(scratch.path / "a" / "0002.png");
  writeTextAtomically(file, "whole");
  CHECK(filesIn(scratch.path) == std::vector<std::string>{"a/0001.png"});
}

TEST_CASE("writeAtomically: two processes that write the same file leave each other's alone", "[tools]") {
  const Scratch scratch;
  const fs::path file = scratch.path / "0001.png";
  int begun[2], onward[2];
  REQUIRE((pipe(begun) == 0 && pipe(onward) == 0));
  char byte = 'x';
  const pid_t child = writer(file, [&] {
    if (write(begun[1], &byte, 1) != 1 || read(onward[0], &byte, 1) != 1) _exit(1);
  });
  REQUIRE(read(begun[0], &byte, 1) == 1);
  writeTextAtomically(file, "mine");
  CHECK(readBytes(file) == "mine");
  CHECK(filesIn(scratch.path).size() == 2);
  REQUIRE(write(onward[1], &byte, 1) == 1);
  int status = -1;
  waitpid(child, &status, 0);
  CHECK(status == 0);
  CHECK(readBytes(file) == "half and half");
  CHECK(filesIn(scratch.path) == std::vector<std::string>{"0001.png"});
}

TEST_CASE("writeAtomically: what another machine's processes write, or have left, stays", "[tools]") {
  const Scratch scratch;
  // No process has this number here.
  const std::string other = ".tmp-another_machine-2147483647-0001.png";
  std::ofstream(scratch.path / other) << "half";
  writeTextAtomically(scratch.path / "0001.png", "whole");
  CHECK(filesIn(scratch.path) == std::vector<std::string>{other, "0001.png"});
  removeTemporaries(scratch.path);
  CHECK(filesIn(scratch.path) == std::vector<std::string>{"0001.png"});
}

TEST_CASE("withTemporaryFolder: it is empty, in the folder, and gone afterwards", "[tools]") {
  const Scratch scratch;
  const fs::path folder = scratch.path / "out";
  fs::path seen;
  const auto work = [&](const fs::path& temporary) {
    seen = temporary;
    CHECK(temporary.parent_path() == folder);
    CHECK(fs::is_empty(temporary));
    std::ofstream(temporary / "file") << "x";
  };
  withTemporaryFolder(folder, "tries", work);
  CHECK_FALSE(seen.empty());
  CHECK_THROWS_AS(withTemporaryFolder(folder, "tries",
                                      [&](const fs::path& temporary) {
                                        work(temporary);
                                        throw std::runtime_error("no");
                                      }),
                  std::runtime_error);
  CHECK(fs::is_empty(folder));
}

TEST_CASE("removeTemporaries: takes away what a killed run left, and only that", "[tools]") {
  const Scratch scratch;
  std::ofstream(scratch.path / ".tmp-0001.png") << "half";
  std::ofstream(scratch.path / "0001.png") << "whole";
  removeTemporaries(scratch.path);
  removeTemporaries(scratch.path / "not there");
  CHECK(filesIn(scratch.path) == std::vector<std::string>{"0001.png"});
}

TEST_CASE("removeFolderAtomically: the folder goes with all in it, one that is not there is no fault",
          "[tools]") {
  const Scratch scratch;
  writeTextAtomically(scratch.path / "0007" / "a" / "b", "x");
  removeFolderAtomically(scratch.path / "0007");
  removeFolderAtomically(scratch.path / "0007");
  CHECK(fs::is_empty(scratch.path));
}
