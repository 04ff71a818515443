#include "tools/command_line/parse.h"

#include "scenes/faults.h"
#include "tools/base/errors.h"

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <type_traits>

namespace fluidtex::tools {
namespace {

CLI::Option* addTo(CLI::App& app, const Option& option) {
  return std::visit(
      [&](auto* target) {
        if constexpr (std::is_same_v<decltype(target), bool*>)
          return app.add_flag(option.name, *target, option.text);
        else
          return app.add_option(option.name, *target, option.text)->type_name(option.value);
      },
      option.target);
}

CLI::Validator endsWith(const std::string& ending) {
  return CLI::Validator(
      [ending](const std::string& file) {
        return file.ends_with(ending) ? std::string() : fmt::format("{}: does not end in {}", file, ending);
      },
      "");
}

void addOption(CLI::App& app, const Option& option) {
  CLI::Option* added = addTo(app, option);
  const Takes& takes = option.takes;
  added->required(takes.required);
  if (!takes.words.empty()) added->check(CLI::IsMember(takes.words));
  if (std::isfinite(takes.least)) {
    if (std::holds_alternative<int*>(option.target))
      added->check(CLI::Range(static_cast<int>(takes.least), static_cast<int>(takes.most)));
    else
      added->check(CLI::Range(takes.least, takes.most));
  }
  if (!takes.ending.empty()) added->check(endsWith(takes.ending));
  if (takes.withCommas) added->delimiter(',');
  if (!takes.with.empty()) added->needs(app.get_option(takes.with));
  if (std::holds_alternative<std::vector<std::string>*>(option.target) && option.name.starts_with('-'))
    added->expected(1)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void define(CLI::App& app, const Program& program) {
  app.require_subcommand(1);
  app.footer(program.footer);
  app.set_help_flag(kHelpOption.name, kHelpOption.text);
  app.set_version_flag(kVersionOption.name, program.version, kVersionOption.text);
  for (const Command& command : program.commands) {
    CLI::App* added = app.add_subcommand(command.name, command.text);
    added->footer(command.footer);
    for (const Option& option : command.options) addOption(*added, option);
  }
}

// A sentence where there is no such command, with what was meant, as far as that can be told; else empty.
std::string unknownCommand(const Program& program, const std::string& name) {
  std::vector<std::string> known;
  for (const Command& command : program.commands) {
    if (command.name == name) return {};
    known.push_back(command.name);
  }
  if (std::error_code unknown; std::filesystem::exists(name, unknown))
    return fmt::format("{0}: no such command; to run a scene or texture a cache, {1} run {0}", name,
                       program.name);
  if (const std::string near = scenes::nearestName(name, known); !near.empty())
    return fmt::format("{}: no such command; did you mean {}?", name, near);
  return fmt::format("{}: no such command; there are {}", name, scenes::listed(known));
}

// What is wrong with the arguments, and where to read what would be right.
std::string argumentFault(const CLI::App& app, const CLI::ParseError& error) {
  std::string what = error.what();
  if (what.size() > 1 && !std::isupper(static_cast<unsigned char>(what[1])))
    what[0] = char(std::tolower(static_cast<unsigned char>(what[0])));
  std::string command = app.get_name() + " help";
  if (const auto chosen = app.get_subcommands(); !chosen.empty()) command += " " + chosen.front()->get_name();
  return fmt::format("{}; `{}` says what can be given", what, command);
}

}  // namespace

Asked parse(const Program& program, int argc, const char* const* argv) {
  if (argc > 1 && argv[1][0] != '-')
    if (const std::string fault = unknownCommand(program, argv[1]); !fault.empty()) throw UsageError(fault);
  CLI::App app(program.text, program.name);
  define(app, program);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::ostringstream out, err;
    if (app.exit(error, out, err) != 0) throw UsageError(argumentFault(app, error));
    return {nullptr, out.str()};
  }
  const std::string chosen = app.get_subcommands().front()->get_name();
  const auto command = std::find_if(program.commands.begin(), program.commands.end(),
                                    [&](const Command& c) { return c.name == chosen; });
  return {&*command, {}};
}

std::string helpOf(const Program& program, const std::string& command) {
  CLI::App app(program.text, program.name);
  define(app, program);
  return command.empty() ? app.help() : app.get_subcommand(command)->help(program.name);
}

}  // namespace fluidtex::tools
