#include "tools/command_line/manual_page.h"

#include <fmt/core.h>

#include <sstream>

namespace fluidtex::tools {
namespace {

// ASCII text as man(7) shows it letter by letter.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '\\')
      result += "\\e";
    else if (c == '-')
      result += "\\-";  // a minus that can be typed again
    else if (c == '\'')
      result += "\\(aq";
    else if (c == '`')
      result += "\\(ga";
    else if (c == '^')
      result += "\\(ha";
    else if (c == '~')
      result += "\\(ti";
    else
      result += c;
  }
  // A line that begins with a dot would be a macro.
  return !result.empty() && result.front() == '.' ? "\\&" + result : result;
}

std::string bold(const std::string& text) {
  return "\\fB" + escaped(text) + "\\fR";
}

std::string italic(const std::string& text) {
  return "\\fI" + escaped(text) + "\\fR";
}

// "-V, --version", "--out DIR", "SCENE".
std::string headOf(const Option& option) {
  std::string head;
  for (const std::string& name : namesOf(option)) head += (head.empty() ? "" : ", ") + bold(name);
  if (!option.value.empty()) head += (head.empty() ? "" : " ") + italic(option.value);
  return isByPlace(option) && isRepeated(option) ? head + " ..." : head;
}

std::string usageOf(const Program& program, const Command& command) {
  std::string usage = bold(program.name + " " + command.name);
  for (const Option& option : allOptions(command)) {
    if (!isByPlace(option)) continue;
    const std::string head = headOf(option);
    usage += " " + (option.takes.required ? head : "[" + head + "]");
  }
  for (const Option& option : allOptions(command))
    if (!isByPlace(option) && option.takes.required) usage += " " + headOf(option);
  return usage + " [" + italic("OPTION") + " ...]";
}

// Lines that begin with two spaces are as typed.
std::string footerOf(const std::string& footer) {
  std::string page;
  bool typed = false;
  std::istringstream lines(footer);
  for (std::string line; std::getline(lines, line);) {
    if (line.empty()) continue;
    const bool example = line.starts_with("  ");
    if (example != typed) page += example ? ".PP\n.EX\n" : ".EE\n";
    if (!example && !typed) page += ".PP\n";
    typed = example;
    page += escaped(example ? line.substr(2) : line) + "\n";
  }
  return typed ? page + ".EE\n" : page;
}

std::string listOf(const std::vector<Option>& options) {
  std::string page;
  for (const Option& option : options)
    page += fmt::format(".TP\n{}\n{}\n", headOf(option), escaped(option.text));
  return page;
}

}  // namespace

std::string manualPage(const Program& program) {
  std::string page = fmt::format(".TH FLUIDTEX 1 \"\" \"{}\" \"User Commands\"\n", escaped(program.version));
  page +=
      fmt::format(".SH NAME\n{} \\- simulates liquids and covers their surface with texture\n", program.name);
  page += ".SH SYNOPSIS\n";
  for (const Command& command : program.commands) page += usageOf(program, command) + "\n.br\n";
  page += bold(program.name) + " " + bold("--help") + " | " + bold("--version") + "\n";
  page += ".SH DESCRIPTION\n" + escaped(program.text) + "\n" + listOf(allOptions(program)) + ".SH COMMANDS\n";
  for (const Command& command : program.commands)
    page += fmt::format(".SS {}\n{}.\n{}{}", escaped(command.name), escaped(command.text),
                        listOf(allOptions(command)), footerOf(command.footer));
  return page + ".SH NOTES\n" + footerOf(program.footer);
}

}  // namespace fluidtex::tools
