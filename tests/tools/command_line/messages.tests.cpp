// What is said while a scene is read and run, on a terminal and in pictures, and where something does not
// fit.
#include "tests/tools/command_line/asked.h"

#include <OpenImageIO/imageio.h>

#include <fstream>
#include <regex>

namespace fs = std::filesystem;
using Catch::Contains;
using Catch::EndsWith;
using Catch::StartsWith;

TEST_CASE("command line: a run says what fits, and where its video is", "[tools][command_line]") {
  const Scratch scratch;
  const std::string out = (scratch.path / "out").string();
  const Finished run = runProgram({"run", kSmallScene, "--frames", "1:2", "--out", out});
  INFO(run.all());
  REQUIRE(run.exitCode == 0);
  // 3000 points, 256 x 256 pixels: 55 x 55 of them fit.
  CHECK_THAT(run.err, Contains("note: 4.6% of green_scales.png's 256 x 256 pixels fit") &&
                          Contains("scaled to about 55 x 55 pixels") && Contains("texture.points=66000"));
  CHECK_THAT(run.err, Contains("done: " + out + "/small.mp4\n"));
  CHECK_THAT(run.err, !Contains("\r") && !Contains("\033"));
  const Finished fits = runProgram(
      {"run", kSmallScene, "--frames", "1:1", "--no-render", "--set", "texture.points=17000", "--out", out});
  CHECK_THAT(fits.err, !Contains("note: ") && Contains("done: " + out + "/surface\n"));
  const std::string plan = runProgram({"check", kSmallScene}).out;
  CHECK_THAT(plan, Contains("scaled to about 55 x 55 pixels") && Contains("\ntime      about ") &&
                       !Contains(" ways "));
  CHECK_THAT(runProgram({"check", kSmallScene, "--set", "texture.orientation.symmetry=4", "--set",
                         "texture.orientation.mirrored=true"})
                 .out,
             Contains("searched in 8 ways") && Contains("about 3 times as long"));
}

TEST_CASE("command line: on a terminal the frame goes up only, and words are coloured unless NO_COLOR is set",
          "[tools][command_line]") {
  const Scratch scratch;
  const std::string out = (scratch.path / "out").string(), program = FLUIDTEX_PROGRAM;
  const auto typed = [](const std::string& line) {
    return said({"script", "-qec", line + "; true", "/dev/null"});
  };
  const std::string drawn =
      typed("TERM=xterm " + program + " run " + kSmallScene + " --quality preview --no-render --out " + out);
  static const std::regex kFrame("frame ([0-9]+)/5  ([a-z]+)");
  int last = 0, drawings = 0;
  for (std::sregex_iterator it(drawn.begin(), drawn.end(), kFrame), end; it != end; ++it, ++drawings) {
    const int frame = std::stoi((*it)[1]);
    CHECK(frame >= last);
    last = frame;
  }
  CHECK(drawings > 2);
  CHECK_THAT(drawn, Contains("\033[1;33mwarning\033[0m: --quality preview"));
  // The line that is drawn anew is gone when the last word is said.
  CHECK_THAT(drawn, Contains("\r\033[Kdone: " + out + "/surface"));
  const std::string plain =
      typed("NO_COLOR=1 TERM=xterm " + program + " check " + kSmallScene + " --quality preview");
  CHECK_THAT(plain, Contains("warning: --quality preview") && !Contains("\033"));
  const std::string dumb =
      typed("TERM=dumb " + program + " run " + kSmallScene + " --frames 1:2 --no-render --out " + out);
  CHECK_THAT(dumb, Contains("frame 2/2: ") && !Contains("\033"));
}

TEST_CASE("command line: render tells that there is no such run", "[tools][command_line]") {
  const Finished none = runProgram({"render", kSmallScene, "--from", "/nothing"});
  CHECK(none.exitCode == 1);
  CHECK_THAT(none.err, StartsWith("error: --from /nothing: there is no such folder") && EndsWith("\n"));
  CHECK(linesOf(none.err) == 1);
}
