// The program as a whole, on the smallest scene that passes every stage.
#include "tests/tools/program.h"

#include <catch2/catch.hpp>

namespace fs = std::filesystem;

TEST_CASE("fluidtex: wrong input exits with 1 and one sentence on stderr", "[tools]") {
  const Scratch scratch;
  const std::string out = (scratch.path / "out").string();
  const auto refused = [](const std::vector<std::string>& args, const std::string& words) {
    const Finished run = runProgram(args);
    CHECK(run.exitCode == 1);
    CHECK(run.out.empty());
    CHECK(occurrences(run.err, "\n") == 1);
    CHECK(occurrences(run.err, words) == 1);
  };
  refused({"run", "no_such_scene.toml", "--out", out}, "no_such_scene.toml:1:1: ");
  refused({"run", kSmallScene, "--set", "texture.windwos=[9]", "--out", out},
          "did you mean texture.windows?");
  refused({"run", kSmallScene, "--frames", "3:1", "--out", out}, "ends before it begins");
  refused({"run", kSmallScene, "--frames", "1:99", "--out", out}, "the scene has 5 frames");
  refused({"run", kSmallScene, "--frames", "x", "--out", out}, "is no range of frames");
  refused({"run", kSmallScene, "--exemplar", kSmallScene, "--out", out},
          "small.toml cannot be read as an image: ");
  refused({"check", kSmallScene, "--exemplar", kSmallScene}, "small.toml cannot be read as an image: ");
  refused({"walk"}, "walk: no such command");
  CHECK_FALSE(fs::exists(fs::path(out) / "frames"));
}

TEST_CASE("fluidtex: version, help with an example for each subcommand, and the plan of a scene", "[tools]") {
  CHECK_THAT(runProgram({"--version"}).out, Catch::StartsWith("fluidtex "));
  for (const char* command : {"run", "simulate", "texture", "check"}) {
    const Finished help = runProgram({command, "--help"});
    CHECK(help.exitCode == 0);
    CHECK_THAT(help.out, Catch::Contains("Example") && Catch::Contains("--quality"));
  }
  const Finished plan = runProgram({"check", kSmallScene});
  INFO(plan.all());
  CHECK(plan.exitCode == 0);
  CHECK(plan.err.empty());
  CHECK_THAT(plan.out, Catch::Contains("24 x 15 x 15 cells") && Catch::Contains("3000 on the first surface"));
  // A layer that the domain's wall cuts is a cell for the solver.
  CHECK_THAT(runProgram({"check", kSmallScene, "--set", "domain.size=[1, 0.6, 0.6]"}).out,
             Catch::Contains("24 x 15 x 15 cells"));
  // What sources will bring is not made up, whether the scene starts dry or not.
  for (const std::vector<std::string>& liquid : {std::vector<std::string>{}, {"--set", "liquid=[]"}}) {
    std::vector<std::string> args{
        "check", kSmallScene,
        "--set", "source=[{ box = { min = [0, 0, 0.2], max = [0.1, 0.6, 0.4] }, velocity = [1, 0, 0] }]",
        "--set", "texture.spacing=0.01"};
    args.insert(args.end(), liquid.begin(), liquid.end());
    const Finished fed = runProgram(args);
    INFO(fed.all());
    CHECK(fed.exitCode == 0);
    CHECK_THAT(fed.out, Catch::Contains("one every 0.01 m, as many as what flows in needs") &&
                            Catch::Contains("kB a cell of what flows in") &&
                            !Catch::Contains("cover the surface"));
  }
  // By number, they are counted on what the scene will hold: not on the first trickle.
  const Finished dry = runProgram(
      {"check", kSmallScene, "--set", "liquid=[]", "--set",
       "source=[{ box = { min = [0.4, 0.2, 0.4], max = [0.5, 0.3, 0.5] }, velocity = [0, 0, -1] }]"});
  INFO(dry.all());
  CHECK(dry.exitCode == 0);
  CHECK_THAT(dry.out,
             Catch::Contains("points    3000 on the ") && Catch::Contains(" m2 that the liquid may come to"));
}

TEST_CASE("fluidtex: what was asked for and cannot be printed is a failure", "[tools]") {
  const auto full = [] { dup2(open("/dev/full", O_WRONLY), STDOUT_FILENO); };
  const auto closed = [] { close(STDOUT_FILENO); };
  for (const std::vector<std::string>& args :
       {std::vector<std::string>{"check", kSmallScene}, {"--help"}, {"--version"}, {"validate", "--list"}}) {
    INFO(args[0]);
    const Finished run = runProgramWith(full, args);
    CHECK(run.exitCode == 2);
    CHECK_THAT(run.err, Catch::Contains("No space left on device") && Catch::EndsWith("\n"));
    CHECK(occurrences(run.err, "\n") == 1);
    CHECK(runProgramWith(closed, args).exitCode == 2);
  }
  CHECK(runProgramWith(full, {"check", kSmallScene, "--quiet"}).exitCode == 0);
}
