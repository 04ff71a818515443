// fluidtex completion: the scripts, as the shells read them.
#include "tests/tools/command_line/asked.h"

#include <fstream>

namespace fs = std::filesystem;
using Catch::Contains;
using Catch::StartsWith;

namespace {

fs::path scriptOf(const std::string& shell, const fs::path& folder) {
  const Finished made = runProgram({"completion", shell});
  REQUIRE(made.exitCode == 0);
  std::ofstream(folder / shell) << made.out;
  return folder / shell;
}

}  // namespace

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
