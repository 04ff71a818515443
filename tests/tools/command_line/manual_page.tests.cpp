// fluidtex man, as groff and mandoc read it.
#include "tests/tools/command_line/asked.h"

#include <fstream>

namespace fs = std::filesystem;
using Catch::Contains;
using Catch::StartsWith;
using fluidtex::render::runOther;

TEST_CASE("command line: the manual page has every command and option, and is read without a warning",
          "[tools][command_line]") {
  const Scratch scratch;
  const Finished made = runProgram({"man"});
  REQUIRE(made.exitCode == 0);
  const fs::path page = scratch.path / "fluidtex.1";
  std::ofstream(page) << made.out;
  CHECK_THAT(made.out, StartsWith(".TH FLUIDTEX 1 ") && Contains(".SH NAME\n") && Contains(".SH SYNOPSIS\n"));
  if (!installed("groff")) {
    WARN("groff is not installed");
    return;
  }
  const std::string text = said({"groff", "-ww", "-man", "-Tascii", "-P-c", "-P-b", "-P-u", page.string()});
  for (const std::string& command : commands()) {
    CHECK_THAT(text, Contains("\n   " + command + "\n"));
    for (const std::string& option : longOptionsOf(command)) CHECK_THAT(text, Contains(option));
  }
  CHECK_THAT(text, Contains("fluidtex check scenes/dam_break.toml --quality final"));
  if (installed("mandoc"))
    CHECK(runOther({"mandoc", "-T", "lint", "-W", "error", page.string()}).output.empty());
}
