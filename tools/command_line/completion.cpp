#include "tools/command_line/completion.h"

#include <fmt/core.h>

#include <algorithm>

namespace fluidtex::tools {
namespace {

std::string joined(const std::vector<std::string>& words, const std::string& between) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

// In single quotes; each of `special` with a backslash before it.
std::string quoted(const std::string& text, const std::string& special = "",
                   const std::string& quote = "'\\''") {
  std::string result = "'";
  for (const char c : text) {
    if (special.find(c) != special.npos) result += '\\';
    result += c == '\'' ? quote : std::string(1, c);
  }
  return result + "'";
}

std::vector<std::string> namesOf(const std::vector<DescribedOption>& options) {
  std::vector<std::string> names;
  for (const DescribedOption& option : options)
    names.insert(names.end(), option.names.begin(), option.names.end());
  return names;
}

std::vector<std::string> namesOf(const DescribedProgram& program) {
  std::vector<std::string> names;
  for (const DescribedCommand& command : program.commands) names.push_back(command.name);
  return names;
}

const DescribedOption* firstByPlace(const DescribedCommand& command) {
  const auto found = std::find_if(command.options.begin(), command.options.end(),
                                  [](const DescribedOption& option) { return option.byPlace(); });
  return found == command.options.end() ? nullptr : &*found;
}

// bash

std::string bashOffer(const DescribedOption& option) {
  switch (option.kind) {
    case ValueKind::words:
      return "_fluidtex_words " + quoted(joined(option.words, " "));
    case ValueKind::keys:
      return "_fluidtex_keys";
    case ValueKind::files:
      return "_fluidtex_files -f";
    case ValueKind::folders:
      return "_fluidtex_files -d";
    default:
      return ":";
  }
}

std::string bashScript(const DescribedProgram& program, const std::vector<std::string>& keys) {
  std::string values, options, places;
  for (const DescribedCommand& command : program.commands) {
    for (const DescribedOption& option : command.options) {
      if (option.byPlace() || option.value.empty()) continue;
      std::vector<std::string> patterns;
      for (const std::string& name : option.names) patterns.push_back(command.name + " " + name);
      values += fmt::format("    \"{}\") {}; return ;;\n", joined(patterns, "\" | \""), bashOffer(option));
    }
    options += fmt::format("    -*,{}) _fluidtex_words {} ;;\n", command.name,
                           quoted(joined(namesOf(command.options), " ")));
    if (const DescribedOption* place = firstByPlace(command))
      places += fmt::format("    *,{}) {} ;;\n", command.name, bashOffer(*place));
  }
  return fmt::format(
      R"(# bash completion of fluidtex, made by: fluidtex completion bash
_fluidtex_words() {{
  mapfile -t COMPREPLY < <(compgen -W "$1" -- "$current")
}}
_fluidtex_keys() {{
  compopt -o nospace
  _fluidtex_words {6}
}}
_fluidtex_files() {{
  compopt -o filenames
  mapfile -t COMPREPLY < <(compgen "$1" -- "$current")
}}
_fluidtex() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD - 1]}} command='' word
  COMPREPLY=()
  for word in "${{COMP_WORDS[@]:1:COMP_CWORD-1}}"; do
    case $word in
      {0}) command=$word; break ;;
    esac
  done
  case "$command $previous" in
{1}  esac
  case "$current,$command" in
    -*,) _fluidtex_words {2} ;;
    *,) _fluidtex_words {3} ;;
{4}{5}  esac
}}
complete -F _fluidtex fluidtex
)",
      joined(namesOf(program), " | "), values, quoted(joined(namesOf(program.options), " ")),
      quoted(joined(namesOf(program), " ")), options, places, quoted(joined(keys, " ")));
}

// zsh

std::string zshAction(const DescribedOption& option) {
  switch (option.kind) {
    case ValueKind::words:
      return "(" + joined(option.words, " ") + ")";
    case ValueKind::keys:
      return "_fluidtex_keys";
    case ValueKind::files:
      return "_files";
    case ValueKind::folders:
      return "_files -/";
    default:
      return " ";
  }
}

std::string zshSpecs(const DescribedCommand& command) {
  std::string specs;
  int place = 0;
  for (const DescribedOption& option : command.options) {
    const std::string value = option.value.empty() ? "" : ":" + option.value + ":" + zshAction(option);
    if (option.byPlace()) {
      specs += " \\\n        " + quoted((option.repeated ? "*" : std::to_string(++place)) + value);
      continue;
    }
    for (const std::string& name : option.names)
      specs += " \\\n        " + quoted((option.repeated ? "*" : "") + name) + "'['" +
               quoted(option.text, ":[]\\") + "']'" + quoted(value);
  }
  return specs;
}

std::string zshScript(const DescribedProgram& program, const std::vector<std::string>& keys) {
  std::string commands, cases;
  for (const DescribedCommand& command : program.commands) {
    commands += "    " + quoted(command.name + ":" + command.text) + "\n";
    cases += fmt::format("    {})\n      _arguments -s{} ;;\n", command.name, zshSpecs(command));
  }
  return fmt::format(
      R"(#compdef fluidtex
# zsh completion of fluidtex, made by: fluidtex completion zsh
_fluidtex_keys() {{
  compadd -S '' -- {}
}}
_fluidtex() {{
  local -a commands=(
{}  )
  if (( CURRENT == 2 )); then
    if [[ $words[2] == -* ]]; then
      compadd -- {}
    else
      _describe command commands
    fi
    return
  fi
  shift words
  (( CURRENT-- ))
  case $words[1] in
{}  esac
}}
if [[ $funcstack[1] == _fluidtex ]]; then _fluidtex "$@"; else compdef _fluidtex fluidtex; fi
)",
      joined(keys, " "), commands, joined(namesOf(program.options), " "), cases);
}

// fish

std::string fishOffer(const DescribedOption& option) {
  switch (option.kind) {
    case ValueKind::none:
      return "";
    case ValueKind::words:
      return " -x -a " + quoted(joined(option.words, " "), "\\", "\\'");
    case ValueKind::keys:
      return " -x -a '$__fluidtex_keys'";
    case ValueKind::files:
      return " -r -F";
    case ValueKind::folders:
      return " -x -a '(__fish_complete_directories)'";
    case ValueKind::any:
      return " -x";
  }
  return "";
}

std::string fishLine(const std::string& condition, const DescribedOption& option) {
  std::string line = "complete -c fluidtex -n " + quoted(condition);
  for (const std::string& name : option.names)
    line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  return line + fishOffer(option) + (option.byPlace() ? "" : " -d " + quoted(option.text, "\\", "\\'")) +
         "\n";
}

std::string fishScript(const DescribedProgram& program, const std::vector<std::string>& keys) {
  std::string script =
      "# fish completion of fluidtex, made by: fluidtex completion fish\ncomplete -c fluidtex -f\n";
  script += "set -g __fluidtex_keys " + joined(keys, " ") + "\n";
  for (const DescribedOption& option : program.options) script += fishLine("__fish_use_subcommand", option);
  for (const DescribedCommand& command : program.commands)
    script += fmt::format("complete -c fluidtex -n __fish_use_subcommand -a {} -d {}\n", command.name,
                          quoted(command.text, "\\", "\\'"));
  for (const DescribedCommand& command : program.commands)
    for (const DescribedOption& option : command.options)
      if (!option.byPlace() || option.kind != ValueKind::any)
        script += fishLine("__fish_seen_subcommand_from " + command.name, option);
  return script;
}

}  // namespace

std::string completionScript(const DescribedProgram& program, const std::vector<std::string>& keys,
                             const std::string& shell) {
  if (shell == "zsh") return zshScript(program, keys);
  return shell == "fish" ? fishScript(program, keys) : bashScript(program, keys);
}

}  // namespace fluidtex::tools
