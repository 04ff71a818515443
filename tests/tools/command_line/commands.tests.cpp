// What is asked first: help, version, a scene to begin with, what is installed.
#include "tests/tools/command_line/asked.h"

#include <fstream>
#include <regex>

namespace fs = std::filesystem;
using Catch::Contains;
using Catch::EndsWith;
using Catch::StartsWith;

namespace {

Finished fromStdin(const fs::path& file, const std::vector<std::string>& args, const fs::path& from) {
  return RunningProgram(args, from, {}, [file] { dup2(open(file.c_str(), O_RDONLY), STDIN_FILENO); }).wait();
}

}  // namespace

TEST_CASE("command line: help, version and their ways of asking", "[tools][command_line]") {
  const std::string version = runProgram({"--version"}).out;
  CHECK_THAT(version, StartsWith("fluidtex ") && EndsWith("\n"));
  CHECK(linesOf(version) == 1);
  for (const char* word : {"version", "-V"}) CHECK(runProgram({word}).out == version);
  const std::string help = runProgram({"--help"}).out;
  CHECK(runProgram({"help"}).out == help);
  CHECK(runProgram({"-h"}).out == help);
  const std::vector<std::string> all = commands();
  CHECK(all.size() >= 15);
  for (const std::string& command : all) {
    const Finished asked = runProgram({command, "--help"});
    INFO(command);
    CHECK(asked.exitCode == 0);
    CHECK(runProgram({"help", command}).out == asked.out);
  }
  const Finished unknown = runProgram({"help", "walk"});
  CHECK(unknown.exitCode == 1);
  CHECK_THAT(runProgram({"rum"}).err, Contains("rum: no such command; did you mean run?"));
  CHECK(runProgram({}).err == "error: a subcommand is required; `fluidtex help` says what can be given\n");
  CHECK(runProgram({"run"}).err == "error: scene is required; `fluidtex help run` says what can be given\n");
  const Finished bogus = runProgram({"check", "a.toml", "--bogus"});
  CHECK(bogus.exitCode == 1);
  CHECK_THAT(bogus.err,
             StartsWith("error: the following argument was not expected: --bogus; `fluidtex help check`"));
  CHECK_THAT(runProgram({kSmallScene}).err, Contains("fluidtex run " + kSmallScene));
}

TEST_CASE("command line: to answer, no library is loaded that only pictures need", "[tools][command_line]") {
  const auto list = [] { setenv("LD_TRACE_LOADED_OBJECTS", "1", 1); };
  const Finished libraries = runProgramWith(list, {"--version"});
  INFO(libraries.out);
  CHECK(linesOf(libraries.out) > 5);
  CHECK(linesOf(libraries.out) < 60);
  CHECK_THAT(libraries.out, !Contains("OpenImageIO") && !Contains("opencv") && !Contains("avcodec"));
}

TEST_CASE("command line: a scene comes on stdin", "[tools][command_line]") {
  const Scratch scratch;
  const fs::path scene = kSmallScene, folder = scene.parent_path();
  Finished piped = fromStdin(scene, {"check", "-"}, folder);
  INFO(piped.all());
  CHECK(piped.exitCode == 0);
  CHECK_THAT(piped.out, Contains("stdin: valid"));
  const std::string out = (scratch.path / "out").string();
  piped = fromStdin(scene, {"run", "-", "--frames", "1:1", "--no-render", "--out", out}, folder);
  CHECK(piped.exitCode == 0);
  REQUIRE(runProgram({"run", kSmallScene, "--frames", "1:1", "--no-render", "--out", out + "2"}).exitCode ==
          0);
  CHECK(resultsIn(out).size() == 1);
  CHECK(resultsIn(out) == resultsIn(out + "2"));
  const fs::path wrong = scratch.path / "wrong.toml";
  std::ofstream(wrong) << "frames = 0\n";
  piped = fromStdin(wrong, {"check", "-"}, scratch.path);
  CHECK(piped.exitCode == 1);
  CHECK_THAT(piped.err, StartsWith("stdin:1:1: error: frames: "));
  piped = fromStdin("/dev/null", {"check", "-"}, scratch.path);
  CHECK(piped.exitCode == 1);
  CHECK_THAT(piped.err, Contains("no scene comes on stdin") && EndsWith("\n"));
}

TEST_CASE("command line: a new scene is valid, with every key that is commented out too",
          "[tools][command_line]") {
  const Scratch scratch;
  for (const std::string& name : {std::string("first"), std::string("Föhn & 50 %/zwei drei.toml")}) {
    const Finished made = runProgram({"new", name}, scratch.path);
    INFO(made.all());
    REQUIRE(made.exitCode == 0);
    const fs::path file = scratch.path / (name.ends_with(".toml") ? name : name + ".toml");
    const Finished plan = runProgram({"check", file.string()});
    INFO(plan.all());
    CHECK(plan.exitCode == 0);
    CHECK(plan.err.empty());
    const std::string before = readBytes(file);
    CHECK(linesOf(before) > 60);
    // Nothing is overwritten.
    const Finished again = runProgram({"new", name}, scratch.path);
    CHECK(again.exitCode == 1);
    CHECK_THAT(again.err, Contains("is there already"));
    CHECK(readBytes(file) == before);
    // Without the sign in front the keys hold what they hold anyway.
    static const std::regex kKey("(^|\n)#([a-z_]+ = )");
    const fs::path whole = file.parent_path() / "whole.toml";
    const std::string all = std::regex_replace(before, kKey, "$1$2");
    CHECK(all.size() + 15 < before.size());
    std::ofstream(whole) << all;
    const Finished full = runProgram({"check", whole.string(), "--quality", "final"});
    INFO(full.all());
    CHECK(full.exitCode == 0);
  }
  const Finished own =
      runProgram({"new", "mine", "--exemplar", FLUIDTEX_SOURCE "/scenes/exemplars/lava.png"}, scratch.path);
  CHECK(own.exitCode == 0);
  CHECK_THAT(runProgram({"check", "mine.toml"}, scratch.path).out, Contains("lava.png, 256 x 256 pixels\n"));
  CHECK(runProgram({"new", "other", "--exemplar", kSmallScene}, scratch.path).exitCode == 1);
  CHECK_FALSE(fs::exists(scratch.path / "other.toml"));
}

TEST_CASE("command line: what is there and works, and what does not", "[tools][command_line]") {
  const Finished well = runProgram({"doctor"});
  INFO(well.all());
  CHECK(well.exitCode == 0);
  CHECK_THAT(well.out, Contains("reads pictures") && Contains("makes videos") && Contains("threads") &&
                           Contains("memory") && Contains("gnuplot") && !Contains("FAILS"));
  // An encoder that fails, as one that was built without H.264 does.
  const Scratch scratch;
  std::ofstream(scratch.path / "ffmpeg") << "#!/bin/sh\necho Unknown encoder >&2\nexit 1\n";
  fs::permissions(scratch.path / "ffmpeg", fs::perms::owner_all);
  const Finished ill = RunningProgram({"doctor"}, {}, scratch.path).wait();
  CHECK(ill.exitCode == 2);
  CHECK_THAT(ill.out,
             Contains("FAILS    makes videos") && Contains("Unknown encoder") && Contains("apt-get"));
}
