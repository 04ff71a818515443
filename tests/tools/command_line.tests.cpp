// What a first hour meets: help, completion, the manual page, a scene to begin with, and what is said where
// something does not fit.
#include "render/other_program.h"
#include "tests/tools/program.h"

#include <OpenImageIO/imageio.h>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <fstream>
#include <regex>
#include <sstream>

namespace fs = std::filesystem;
using Catch::Contains;
using Catch::EndsWith;
using Catch::StartsWith;
using fluidtex::render::Outcome;
using fluidtex::render::runOther;

namespace {

int linesOf(const std::string& text) {
  return int(std::count(text.begin(), text.end(), '\n'));
}

std::vector<std::string> commands() {
  // As --help lists them: two spaces, the name, more spaces.
  const std::string help = runProgram({"--help"}).out;
  static const std::regex kLine("\n  ([a-z]+) +[A-Z]");
  std::vector<std::string> names;
  for (std::sregex_iterator it(help.begin(), help.end(), kLine), end; it != end; ++it)
    names.push_back((*it)[1]);
  return names;
}

std::vector<std::string> longOptionsOf(const std::string& command) {
  const std::string help = runProgram({command, "--help"}).out;
  static const std::regex kOption("\n  (?:-[a-zA-Z],)?(--[a-z-]+)");
  std::vector<std::string> names;
  for (std::sregex_iterator it(help.begin(), help.end(), kOption), end; it != end; ++it)
    names.push_back((*it)[1]);
  return names;
}

bool installed(const std::string& program) {
  return runOther({"sh", "-c", "command -v " + program}).exitCode == 0;
}

// What the shell says; nothing where it is not installed.
std::string said(const std::vector<std::string>& arguments) {
  const Outcome outcome = runOther(arguments);
  INFO(outcome.complaints);
  CHECK(outcome.exitCode == 0);
  CHECK(outcome.complaints.empty());
  return outcome.output;
}

fs::path scriptOf(const std::string& shell, const fs::path& folder) {
  const Finished made = runProgram({"completion", shell});
  REQUIRE(made.exitCode == 0);
  std::ofstream(folder / shell) << made.out;
  return folder / shell;
}

std::vector<std::string> fromStdin(const fs::path& file, const std::vector<std::string>& args,
                                   const fs::path& from, Finished& finished) {
  finished = Program(args, from, {}, [file] { dup2(open(file.c_str(), O_RDONLY), STDIN_FILENO); }).wait();
  return args;
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
  Finished piped;
  fromStdin(scene, {"check", "-"}, folder, piped);
  INFO(piped.all());
  CHECK(piped.exitCode == 0);
  CHECK_THAT(piped.out, Contains("stdin: valid"));
  const std::string out = (scratch.path / "out").string();
  fromStdin(scene, {"run", "-", "--frames", "1:1", "--no-render", "--out", out}, folder, piped);
  CHECK(piped.exitCode == 0);
  REQUIRE(runProgram({"run", kSmallScene, "--frames", "1:1", "--no-render", "--out", out + "2"}).exitCode ==
          0);
  CHECK(resultsIn(out).size() == 1);
  CHECK(resultsIn(out) == resultsIn(out + "2"));
  const fs::path wrong = scratch.path / "wrong.toml";
  std::ofstream(wrong) << "frames = 0\n";
  fromStdin(wrong, {"check", "-"}, scratch.path, piped);
  CHECK(piped.exitCode == 1);
  CHECK_THAT(piped.err, StartsWith("stdin:1:1: error: frames: "));
  fromStdin("/dev/null", {"check", "-"}, scratch.path, piped);
  CHECK(piped.exitCode == 1);
  CHECK_THAT(piped.err, Contains("no scene comes on stdin") && EndsWith("\n"));
}

TEST_CASE("command line: bash completes commands, options, words, keys and files", "[tools][command_line]") {
  const Scratch scratch;
  const fs::path script = scriptOf("bash", scratch.path);
  std::ofstream(scratch.path / "one scene.toml") << "";
  fs::create_directories(scratch.path / "a folder");
  const auto completed = [&](const std::string& words) {
    return said(
        {"bash", "-c",
         "compopt() { :; }; cd '" + scratch.path.string() + "' && source '" + script.string() +
             "' && COMP_WORDS=(" + words +
             ") COMP_CWORD=$((${#COMP_WORDS[@]} - 1)) && _fluidtex && printf '%s\\n' \"${COMPREPLY[@]}\""});
  };
  CHECK(completed("fluidtex ru") == "run\n");
  CHECK(completed("fluidtex --vers") == "--version\n");
  CHECK(completed("fluidtex run --qual") == "--quality\n");
  CHECK(completed("fluidtex run --quality p") == "preview\n");
  CHECK(completed("fluidtex run x.toml --set domain.res") == "domain.resolution=\n");
  CHECK(completed("fluidtex run one") == "one scene.toml\n");
  CHECK(completed("fluidtex run x.toml --out a") == "a folder\n");
  CHECK(completed("fluidtex run x.toml --frames 1") == "\n");
  CHECK(completed("fluidtex completion z") == "zsh\n");
  CHECK(completed("fluidtex help sim") == "simulate\n");
  for (const std::string& command : commands()) {
    const std::string offered = "\n" + completed("fluidtex " + command + " --");
    for (const std::string& option : longOptionsOf(command))
      CHECK_THAT(offered, Contains("\n" + option + "\n"));
  }
}

TEST_CASE("command line: zsh and fish read their scripts", "[tools][command_line]") {
  const Scratch scratch;
  const fs::path zsh = scriptOf("zsh", scratch.path), fish = scriptOf("fish", scratch.path);
  if (installed("zsh")) {
    said({"zsh", "-n", zsh.string()});
    // It completes in a terminal only: one is made, keys are typed, and what it draws is waited for.
    const std::string listed =
        said({"timeout", "60", "zsh", "-f", "-c",
              "zmodload zsh/zpty; zpty t zsh -f -i; zpty -w t 'autoload -U compinit; compinit -u -d " +
                  (scratch.path / "dump").string() + "; source " + zsh.string() +
                  "; PS1=; echo re\'\'ady'; "
                  "zpty -r t line '*ready*'; zpty -w -n t $'fluidtex run --qual\\t'; "
                  "zpty -r t line '*--quality*'; print -r -- $line; zpty -w -n t $'\\025fluidtex completion "
                  "f\\t'; "
                  "zpty -r t line '*completion fish*'; print -r -- $line; zpty -d t"});
    CHECK_THAT(listed, Contains("--quality") && Contains("completion fish"));
  } else {
    WARN("zsh is not installed");
  }
  if (!installed("fish")) {
    WARN("fish is not installed");
    return;
  }
  said({"fish", "--no-execute", fish.string()});
  const auto completed = [&](const std::string& line) {
    return said({"fish", "--no-config", "-c", "source '" + fish.string() + "'; complete -C '" + line + "'"});
  };
  CHECK_THAT(completed("fluidtex ru"), StartsWith("run\t"));
  CHECK_THAT(completed("fluidtex run --qual"), StartsWith("--quality\t"));
  CHECK_THAT(completed("fluidtex run --quality p"), StartsWith("preview\t"));
  CHECK_THAT(completed("fluidtex check --set domain.res"), StartsWith("domain.resolution=\t"));
}

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
  const Finished ill = Program({"doctor"}, {}, scratch.path).wait();
  CHECK(ill.exitCode == 2);
  CHECK_THAT(ill.out,
             Contains("FAILS    makes videos") && Contains("Unknown encoder") && Contains("apt-get"));
}

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

TEST_CASE("command line: odd names of files and folders", "[tools][command_line]") {
  const Scratch scratch;
  const fs::path folder = scratch.path / "Öl & Wasser 100 % 'neu' #1 $HOME";
  fs::create_directories(folder);
  const fs::path scene = folder / "große Welle %d.toml", picture = folder / "Bild 50% [1] {2}.png";
  fs::copy_file(FLUIDTEX_SOURCE "/scenes/exemplars/green_scales.png", picture);
  std::string text = readBytes(kSmallScene);
  const std::string shipped = "../../scenes/exemplars/green_scales.png";
  text.replace(text.find(shipped), shipped.size(), picture.filename().string());
  std::ofstream(scene) << text;
  const auto runs = [&](std::vector<std::string> args) {
    const Finished run = runProgram(args, folder);
    INFO(args[0] << ": " << run.all());
    CHECK(run.exitCode == 0);
    return run;
  };
  const std::string out = "Ergebnis & mehr %04d", name = scene.filename().string();
  runs({"check", name});
  runs({"run", name, "--frames", "1:2", "--out", out});
  CHECK(fs::exists(folder / out / "große Welle %d.mp4"));
  runs({"render", name, "--from", out, "--frames", "1:2", "--out", "noch einmal"});
  CHECK(fs::exists(folder / "noch einmal" / "große Welle %d.mp4"));
  runs({"apply", out, "height=" + picture.filename().string()});
  runs({"measure", out, "--json", "Maße & Werte.json"});
  runs({"compare", name, "--frames", "1:2", "--out", "Vergleich & 100 %"});
  CHECK(fs::exists(folder / "Vergleich & 100 %" / "compare.mp4"));
  CHECK(fs::exists(folder / "Vergleich & 100 %" / "compare.jpg"));
  // The liquid of another program, here meshes in numbered files.
  fs::create_directories(folder / "Flüssigkeit & 1 %");
  for (const char* number : {"1", "2", "3"})
    fs::copy_file(folder / out / "surface" / "0001.ply",
                  folder / "Flüssigkeit & 1 %" / ("Netz " + std::string(number) + ".ply"));
  runs({"check", "Flüssigkeit & 1 %"});
  runs({"texture", "Flüssigkeit & 1 %/Netz #.ply", "--exemplar", picture.filename().string(), "--set",
        "texture.points=1000", "--set", "files.least_explained=0", "--frames", "1:2", "--out", "Netze"});
  CHECK(fs::exists(folder / "Netze" / "Netz.mp4"));
  // Cut or cleaned of what only that name means to another program, nothing was written beside it.
  for (const auto& entry : fs::directory_iterator(scratch.path)) CHECK(entry.path() == folder);
}
