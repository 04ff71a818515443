// fluidtex help, version, completion and man: what is made of the commands' own definition.
#include "scenes/writer.h"
#include "tools/base/console.h"
#include "tools/base/errors.h"
#include "tools/command_line/completion.h"
#include "tools/command_line/manual_page.h"
#include "tools/command_line/parse.h"
#include "tools/commands.h"

#include <nlohmann/json.hpp>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace fluidtex::tools {
namespace {

// "KEY=" of all keys of a scene that are not inside of lists, dotted.
std::vector<std::string> sceneKeys() {
  std::vector<std::string> keys;
  const auto gather = [&](const auto& self, const nlohmann::ordered_json& table,
                          const std::string& path) -> void {
    for (const auto& [key, value] : table.items()) {
      if (value.is_object())
        self(self, value, path + key + ".");
      else if (path + key != "quality")
        keys.push_back(path + key + "=");
    }
  };
  gather(gather, nlohmann::ordered_json::parse(scenes::resolvedText({}, scenes::Quality::standard)), "");
  return keys;
}

Command completionCommand(const Program& program) {
  const auto shell = std::make_shared<std::string>();
  Command command{"completion", "Print a script by which a shell completes commands"};
  command.options = {{"shell", shell.get(), "SHELL", "The shell", {.required = true, .words = kShells}}};
  command.footer =
      "Examples:\n  fluidtex completion bash > ~/.local/share/bash-completion/completions/fluidtex\n"
      "  fluidtex completion zsh > ~/.zfunc/_fluidtex\n"
      "  fluidtex completion fish > ~/.config/fish/completions/fluidtex.fish\n"
      "For zsh the folder is to be in fpath: fpath+=~/.zfunc before compinit in ~/.zshrc.";
  command.run = [&program, shell] {
    printText(completionScript(program, sceneKeys(), *shell));
    return kDone;
  };
  return command;
}

Command manCommand(const Program& program) {
  Command command{"man", "Print the manual page"};
  command.footer =
      "Examples:\n  fluidtex man > ~/.local/share/man/man1/fluidtex.1\n  fluidtex man | man -l -";
  command.run = [&program] {
    printText(manualPage(program));
    return kDone;
  };
  return command;
}

Command versionCommand(const Program& program) {
  Command command{"version", "Print the version"};
  command.run = [&program] {
    print("{}\n", program.version);
    return kDone;
  };
  return command;
}

Command helpCommand(const Program& program) {
  const auto asked = std::make_shared<std::string>();
  std::vector<std::string> names;
  names.reserve(program.commands.size() + 1);
  for (const Command& command : program.commands) names.push_back(command.name);
  names.emplace_back("help");
  Command command{"help", "Print what a command does and its options"};
  command.options = {{"command",
                      asked.get(),
                      "COMMAND",
                      "The command; without one, all are listed",
                      {.words = std::move(names)}}};
  command.run = [&program, asked] {
    printText(helpOf(program, *asked));
    return kDone;
  };
  return command;
}

}  // namespace

void addHelp(Program& program) {
  program.commands.push_back(completionCommand(program));
  program.commands.push_back(manCommand(program));
  program.commands.push_back(versionCommand(program));
  program.commands.push_back(helpCommand(program));
}

}  // namespace fluidtex::tools
