// fluidtex help, version, completion and man: what is made of the command line's own definition.
#include "scenes/writer.h"
#include "tools/base/console.h"
#include "tools/base/errors.h"
#include "tools/command_line/completion.h"
#include "tools/command_line/manual_page.h"
#include "tools/commands.h"

#include <nlohmann/json.hpp>

#include <memory>

namespace fluidtex::tools {
namespace {

constexpr const char* kVersion = "fluidtex " FLUIDTEX_VERSION;

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

std::vector<std::string> commandsOf(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands(std::function<bool(const CLI::App*)>{}))
    names.push_back(command->get_name());
  return names;
}

}  // namespace

void addHelp(CLI::App& app, int& exitCode) {
  app.set_version_flag("-V,--version", std::string(kVersion), "Print the version and exit");

  CLI::App* completion =
      app.add_subcommand("completion", "Print a script by which a shell completes commands");
  auto shell = std::make_shared<std::string>();
  completion->add_option("shell", *shell, "The shell")
      ->required()
      ->check(CLI::IsMember(kShells))
      ->type_name("SHELL");
  completion->footer(
      "Examples:\n  fluidtex completion bash > ~/.local/share/bash-completion/completions/fluidtex\n"
      "  fluidtex completion zsh > ~/.zfunc/_fluidtex\n"
      "  fluidtex completion fish > ~/.config/fish/completions/fluidtex.fish\n"
      "For zsh the folder is to be in fpath: fpath+=~/.zfunc before compinit in ~/.zshrc.");
  completion->callback([&app, shell, &exitCode] {
    exitCode = guarded([&] { printText(completionScript(described(app), sceneKeys(), *shell)); });
  });

  CLI::App* man = app.add_subcommand("man", "Print the manual page");
  man->footer("Examples:\n  fluidtex man > ~/.local/share/man/man1/fluidtex.1\n  fluidtex man | man -l -");
  man->callback(
      [&app, &exitCode] { exitCode = guarded([&] { printText(manualPage(described(app), kVersion)); }); });

  app.add_subcommand("version", "Print the version")->callback([&exitCode] {
    exitCode = guarded([] { print("{}\n", kVersion); });
  });

  CLI::App* help = app.add_subcommand("help", "Print what a command does and its options");
  std::vector<std::string> commands = commandsOf(app);
  auto command = std::make_shared<std::string>();
  help->add_option("command", *command, "The command; without one, all are listed")
      ->check(CLI::IsMember(commands))
      ->type_name("COMMAND");
  help->callback([&app, command, &exitCode] {
    exitCode = guarded([&] {
      // Its own help() would be that of the subcommand which was given: of this one.
      printText(command->empty()
                    ? app.get_formatter()->make_help(&app, app.get_name(), CLI::AppFormatMode::Normal)
                    : app.get_subcommand(*command)->help(app.get_name()));
    });
  });
}

}  // namespace fluidtex::tools
