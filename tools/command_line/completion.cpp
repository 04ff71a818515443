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

// What a value of an option is, for those who offer some.
enum class ValueKind { none, any, words, keys, files, folders };

bool isOneOf(const std::string& word, std::initializer_list<const char*> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

ValueKind kindOf(const Option& option) {
  if (option.value.empty()) return ValueKind::none;
  if (!option.takes.words.empty()) return ValueKind::words;
  if (option.value == "KEY=VALUE") return ValueKind::keys;
  if (isOneOf(option.value, {"DIR", "OUT"})) return ValueKind::folders;
  if (isOneOf(option.value, {"SCENE", "IMAGE", "FILE", "PAGE", "NAME=FILE", "KIND=IMAGE"}))
    return ValueKind::files;
  return ValueKind::any;
}

std::vector<std::string> namesOf(const std::vector<Option>& options) {
  std::vector<std::string> names;
  for (const Option& option : options)
    for (const std::string& name : namesOf(option)) names.push_back(name);
  return names;
}

std::vector<std::string> namesOf(const Program& program) {
  std::vector<std::string> names;
  for (const Command& command : program.commands) names.push_back(command.name);
  return names;
}

const Option* firstByPlace(const Command& command) {
  const auto found = std::find_if(command.options.begin(), command.options.end(), isByPlace);
  return found == command.options.end() ? nullptr : &*found;
}

// bash

std::string bashOffer(const Option& option) {
  switch (kindOf(option)) {
    case ValueKind::words:
      return "_fluidtex_words " + quoted(joined(option.takes.words, " "));
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

std::string bashScript(const Program& program, const std::vector<std::string>& keys) {
  std::string values, options, places;
  for (const Command& command : program.commands) {
    for (const Option& option : allOptions(command)) {
      if (isByPlace(option) || option.value.empty()) continue;
      std::vector<std::string> patterns;
      for (const std::string& name : namesOf(option)) patterns.push_back(command.name + " " + name);
      values += fmt::format("    \"{}\") {}; return ;;\n", joined(patterns, "\" | \""), bashOffer(option));
    }
    options += fmt::format("    -*,{}) _fluidtex_words {} ;;\n", command.name,
                           quoted(joined(namesOf(allOptions(command)), " ")));
    if (const Option* place = firstByPlace(command))
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
      joined(namesOf(program), " | "), values, quoted(joined(namesOf(allOptions(program)), " ")),
      quoted(joined(namesOf(program), " ")), options, places, quoted(joined(keys, " ")));
}

// zsh

std::string zshAction(const Option& option) {
  switch (kindOf(option)) {
    case ValueKind::words:
      return "(" + joined(option.takes.words, " ") + ")";
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

std::string zshSpecs(const Command& command) {
  std::string specs;
  int place = 0;
  for (const Option& option : allOptions(command)) {
    const std::string value = option.value.empty() ? "" : ":" + option.value + ":" + zshAction(option);
    if (isByPlace(option)) {
      specs += " \\\n        " + quoted((isRepeated(option) ? "*" : std::to_string(++place)) + value);
      continue;
    }
    for (const std::string& name : namesOf(option))
      specs += " \\\n        " + quoted((isRepeated(option) ? "*" : "") + name) + "'['" +
               quoted(option.text, ":[]\\") + "']'" + quoted(value);
  }
  return specs;
}

std::string zshScript(const Program& program, const std::vector<std::string>& keys) {
  std::string commands, cases;
  for (const Command& command : program.commands) {
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
      joined(keys, " "), commands, joined(namesOf(allOptions(program)), " "), cases);
}

// fish

std::string fishOffer(const Option& option) {
  switch (kindOf(option)) {
    case ValueKind::none:
      return "";
    case ValueKind::words:
      return " -x -a " + quoted(joined(option.takes.words, " "), "\\", "\\'");
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

std::string fishLine(const std::string& condition, const Option& option) {
  std::string line = "complete -c fluidtex -n " + quoted(condition);
  for (const std::string& name : namesOf(option))
    line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  return line + fishOffer(option) + (isByPlace(option) ? "" : " -d " + quoted(option.text, "\\", "\\'")) +
         "\n";
}

std::string fishScript(const Program& program, const std::vector<std::string>& keys) {
  std::string script =
      "# fish completion of fluidtex, made by: fluidtex completion fish\ncomplete -c fluidtex -f\n";
  script += "set -g __fluidtex_keys " + joined(keys, " ") + "\n";
  for (const Option& option : allOptions(program)) script += fishLine("__fish_use_subcommand", option);
  for (const Command& command : program.commands)
    script += fmt::format("complete -c fluidtex -n __fish_use_subcommand -a {} -d {}\n", command.name,
                          quoted(command.text, "\\", "\\'"));
  for (const Command& command : program.commands)
    for (const Option& option : allOptions(command))
      if (!isByPlace(option) || kindOf(option) != ValueKind::any)
        script += fishLine("__fish_seen_subcommand_from " + command.name, option);
  return script;
}

}  // namespace

std::string completionScript(const Program& program, const std::vector<std::string>& keys,
                             const std::string& shell) {
  if (shell == "zsh") return zshScript(program, keys);
  return shell == "fish" ? fishScript(program, keys) : bashScript(program, keys);
}

}  // namespace fluidtex::tools
