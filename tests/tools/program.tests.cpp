// The program as a whole, on the smallest scene that passes every stage.
#include "tests/tools/program.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <fstream>

namespace fs = std::filesystem;

namespace {

long occurrences(const std::string& text, const std::string& words) {
  long count = 0;
  for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) ++count;
  return count;
}

}  // namespace

TEST_CASE("fluidtex run: writes every file of a run, and run.json with every frame", "[tools]") {
  const Scratch scratch;
  const fs::path out = scratch.path / "out";
  const Finished run = runProgram({"run", kSmallScene, "--out", out.string()});
  INFO(run.all());
  REQUIRE(run.exitCode == 0);
  CHECK(run.out.empty());
  CHECK_THAT(run.err, Catch::Contains("frame 5/5"));
  CHECK(filesIn(out) == std::vector<std::string>{"exemplar.png",
                                                 "frames/0001.png",
                                                 "frames/0002.png",
                                                 "frames/0003.png",
                                                 "frames/0004.png",
                                                 "frames/0005.png",
                                                 "log.txt",
                                                 "report.html",
                                                 "run.json",
                                                 "small.mp4",
                                                 "state/0005/manifest.txt",
                                                 "state/0005/run.json",
                                                 "state/0005/solver.vdb",
                                                 "state/0005/surface.bin",
                                                 "state/journal.txt",
                                                 "surface/0001.ply",
                                                 "surface/0002.ply",
                                                 "surface/0003.ply",
                                                 "surface/0004.ply",
                                                 "surface/0005.ply"});
  const auto json = nlohmann::json::parse(readBytes(out / "run.json"));
  REQUIRE(json.at("frames").size() == 5);
  const auto& first = json.at("frames").front();
  const auto& last = json.at("frames").back();
  CHECK(first.at("substeps") == 0);
  CHECK(last.at("substeps").get<int>() >= 1);
  CHECK(last.at("time").get<double>() == Approx(4.0 / 24));
  CHECK(first.at("vertices").get<double>() == Approx(3000).epsilon(0.05));
  // A tank part filled, and a ball: 0.4 x 0.625 x 0.3 + 4/3 pi 0.15^3 cubic metres.
  CHECK(first.at("volume").get<double>() == Approx(0.075 + 0.01414).epsilon(0.05));
  CHECK(last.at("volume").get<double>() == Approx(first.at("volume").get<double>()).epsilon(0.1));
  CHECK(last.at("renewed").get<double>() < 0.9);
  CHECK(json.at("scene").at("seed") == 7);
  // The record of the state lacks the time that the state itself took.
  const auto saved = nlohmann::json::parse(readBytes(out / "state" / "0005" / "run.json"));
  CHECK(last.at("seconds").at("write").get<double>() >
        saved.at("frames").back().at("seconds").at("write").get<double>());
}

TEST_CASE("fluidtex run: the same bytes on one thread as on two", "[tools]") {
  const Scratch scratch;
  for (const char* threads : {"1", "2"}) {
    const Finished run = runProgram({"run", kSmallScene, "--frames", "1:3", "--threads", threads, "--out",
                                     (scratch.path / threads).string()});
    INFO(run.all());
    REQUIRE(run.exitCode == 0);
  }
  const Results one = resultsIn(scratch.path / "1"), two = resultsIn(scratch.path / "2");
  REQUIRE(namesOf(one).size() == 6);
  REQUIRE(namesOf(one) == namesOf(two));
  CHECK(differing(one, two).empty());
}

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

TEST_CASE("fluidtex run --frames: earlier frames are computed and not written", "[tools]") {
  const Scratch scratch;
  const fs::path whole = scratch.path / "whole", part = scratch.path / "part";
  REQUIRE(runProgram({"run", kSmallScene, "--frames", "1:3", "--out", whole.string()}).exitCode == 0);
  REQUIRE(runProgram({"run", kSmallScene, "--frames", "2:3", "--out", part.string()}).exitCode == 0);
  const Results results = resultsIn(part);
  CHECK(namesOf(results) == std::vector<std::string>{"frames/0002.png", "frames/0003.png", "surface/0002.ply",
                                                     "surface/0003.ply"});
  CHECK(differing(results, resultsIn(whole)).empty());
  CHECK(fs::exists(part / "small.mp4"));
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

TEST_CASE("fluidtex: wrong input is refused before anything of an earlier run is lost", "[tools]") {
  const Scratch scratch;
  const fs::path out = scratch.path / "out", rock = scratch.path / "rock.obj";
  REQUIRE(runProgram({"run", kSmallScene, "--frames", "1:1", "--out", out.string()}).exitCode == 0);
  std::ofstream(rock) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const auto before = filesIn(out);
  const std::string log = readBytes(out / "log.txt");
  const std::string mesh = "solid=[{mesh={file='" + rock.string() + "'}}]";
  for (const std::vector<std::string>& args :
       {std::vector<std::string>{"run", kSmallScene, "--set", mesh, "--out", out.string()},
        {"run", kSmallScene, "--set", "liquid.0.mesh={file='" + rock.string() + "'}", "--out", out.string()},
        {"check", kSmallScene, "--quiet", "--set", mesh}}) {
    const Finished run = runProgram(args);
    CHECK(run.exitCode == 1);
    CHECK_THAT(run.err, Catch::Contains("rock.obj: is not closed"));
  }
  CHECK(runProgram({"run", kSmallScene, "--exemplar", rock.string(), "--out", out.string()}).exitCode == 1);
  CHECK(filesIn(out) == before);
  CHECK_THAT(readBytes(out / "log.txt"), Catch::StartsWith(log));
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
