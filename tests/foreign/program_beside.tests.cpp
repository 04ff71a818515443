#include "foreign/program_beside.h"

#include "tests/scratch.h"

#include <catch2/catch.hpp>

namespace fs = std::filesystem;
using fluidtex::foreign::programBeside;

namespace {

// What an installed library says of its programs.
std::string programs = "/nowhere";

void makeProgram(const fs::path& file) {
  std::ofstream(file) << "#!/bin/sh\n";
}

}  // namespace

extern "C" const char* fluidtexPrograms() {
  return programs.c_str();
}

TEST_CASE("program beside: where it was built, if it is nowhere else", "[foreign]") {
  CHECK(programBeside("no_such_program", "/built/no_such_program") == "/built/no_such_program");
}

TEST_CASE("program beside: in an installed library's folder, but first beside the program that runs",
          "[foreign]") {
  const Scratch scratch;
  const fs::path self = fs::read_symlink("/proc/self/exe");
  const std::string own = self.filename();
  makeProgram(scratch.path / "no_such_program");
  makeProgram(scratch.path / own);
  programs = scratch.path;
  const fs::path installed = programBeside("no_such_program", "/built/no_such_program");
  const fs::path beside = programBeside(own, "/built/" + own);
  programs = "/nowhere";
  CHECK(installed == scratch.path / "no_such_program");
  CHECK(beside == self);
}
