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

TEST_CASE("command line: a quality that changes nothing is told of", "[tools][command_line]") {
  const Finished plan = runProgram({"check", kSmallScene, "--quality", "preview"});
  CHECK(plan.exitCode == 0);
  CHECK_THAT(plan.err,
             StartsWith("warning: --quality preview: changes nothing") && Contains("texture.points=N"));
  CHECK(linesOf(plan.err) == 1);
  CHECK(runProgram({"check", kSmallScene, "--quality", "default"}).err.empty());
  CHECK(runProgram({"check", kSmallScene, "--quality", "preview", "--quiet"}).err.empty());
  CHECK(runProgram({"check", FLUIDTEX_SOURCE "/scenes/dam_break.toml", "--quality", "preview"}).err.empty());
}

TEST_CASE("command line: what does not fit is told at the scene's own line", "[tools][command_line]") {
  const Scratch scratch;
  const std::string good = "texture.exemplar = '" FLUIDTEX_SOURCE
                           "/scenes/exemplars/green_scales.png'\ndomain.size = [1, 1, 1]\n[[liquid]]\n"
                           "box = { min = [0, 0, 0], max = [1, 1, 0.3] }\n[[solid]]\n";
  std::ofstream(scratch.path / "open.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  std::ofstream(scratch.path / "bad_1.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  std::ofstream(scratch.path / "no picture.png") << "no picture";
  const auto told = [&](const std::string& scene, const std::vector<std::string>& more = {}) {
    const fs::path file = scratch.path / "s.toml";
    std::ofstream(file) << scene;
    std::vector<std::string> args{"run", "s.toml", "--out", "out", "--frames", "1:1"};
    args.insert(args.end(), more.begin(), more.end());
    const Finished run = runProgram(args, scratch.path);
    INFO(run.all());
    CHECK(run.exitCode == 1);
    CHECK(linesOf(run.err) == 1);
    return run.err;
  };
  CHECK_THAT(told(good + "mesh = { file = 'open.obj' }\n"),
             StartsWith("s.toml:6:10: error: solid.0.mesh.file: open.obj: is not closed"));
  CHECK_THAT(told(good + "mesh_sequence = { files = 'bad_%d.obj', last = 1 }\n"),
             StartsWith("s.toml:6:19: error: solid.0.mesh_sequence.files: bad_1.obj: is not closed"));
  CHECK_THAT(told(good + "height_field = { file = 'no picture.png', pixel = 0.01 }\n"),
             StartsWith("s.toml:6:18: error: solid.0.height_field.file: no picture.png"));
  CHECK_THAT(told(good + "box = { min = [0.5, 0, 0], max = [0.6, 1, 1] }\n[[texture.map]]\nname = 'h'\n"
                         "file = 'no picture.png'\n"),
             StartsWith("s.toml:9:1: error: texture.map.0.file: no picture.png"));
  CHECK_THAT(
      told(good + "box = { min = [0.5, 0, 0], max = [0.6, 1, 1] }\n", {"--exemplar", "no picture.png"}),
      StartsWith("--exemplar no picture.png: error: texture.exemplar: no picture.png"));
}

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

TEST_CASE("command line: pictures hold scene, frame, time and version, and nothing else",
          "[tools][command_line]") {
  const Scratch scratch;
  const fs::path out = scratch.path / "out", again = scratch.path / "again";
  REQUIRE(runProgram({"run", kSmallScene, "--frames", "1:3", "--set", "name=Fluß", "--out", out.string()})
              .exitCode == 0);
  CHECK_THAT(readBytes(out / "frames" / "0003.png"), !Contains(scratch.path.string()) && !Contains("tIME"));
  // Pictures of the surfaces say the same.
  REQUIRE(runProgram({"render", kSmallScene, "--from", out.string(), "--frames", "1:3", "--set", "name=Fluß",
                      "--out", again.string()})
              .exitCode == 0);
  for (const fs::path& folder : {out, again}) {
    const auto input = OIIO::ImageInput::open((folder / "frames" / "0003.png").string());
    REQUIRE(input);
    CHECK(input->spec().get_string_attribute("DocumentName") == "Fluß");
    CHECK(input->spec().get_string_attribute("Frame") == "3");
    CHECK(input->spec().get_string_attribute("Time") == "0.0833333 s");
    CHECK("fluidtex " FLUIDTEX_VERSION == std::string(input->spec().get_string_attribute("Software")));
  }
}

TEST_CASE("command line: render tells that there is no such run", "[tools][command_line]") {
  const Finished none = runProgram({"render", kSmallScene, "--from", "/nothing"});
  CHECK(none.exitCode == 1);
  CHECK_THAT(none.err, StartsWith("error: --from /nothing: there is no such folder") && EndsWith("\n"));
  CHECK(linesOf(none.err) == 1);
}
