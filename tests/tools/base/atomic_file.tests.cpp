#include "tools/base/atomic_file.h"

#include "tests/scratch.h"

#include <catch2/catch.hpp>

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
  // Left from a kill while the same folder was being removed.
  writeTextAtomically(scratch.path / ".tmp-old-0007" / "c", "x");
  removeFolderAtomically(scratch.path / "0007");
  removeFolderAtomically(scratch.path / "0007");
  CHECK(fs::is_empty(scratch.path));
}
