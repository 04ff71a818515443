#include "tools/command_line/described.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <sstream>

namespace fluidtex::tools {
namespace {

bool isOneOf(const std::string& word, std::initializer_list<const char*> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

// The members of a set as the parser writes it: {preview,default,final}.
std::vector<std::string> membersOf(const std::string& type) {
  std::vector<std::string> members;
  const std::size_t begin = type.find('{'), end = type.rfind('}');
  if (begin == type.npos || end == type.npos) return members;
  std::istringstream inside(type.substr(begin + 1, end - begin - 1));
  for (std::string member; std::getline(inside, member, ',');) members.push_back(member);
  return members;
}

DescribedOption describedOption(const CLI::Option& option) {
  DescribedOption result;
  for (const std::string& name : option.get_snames()) result.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) result.names.push_back("--" + name);
  result.text = option.get_description();
  result.required = option.get_required();
  if (option.get_items_expected_max() == 0) return result;  // a flag
  // "NAME:{preview,default,final}", "N:INT in [1 - 4096]", "A:B": the name of the value, then what it may be.
  const std::string type = option.get_type_name();
  result.value = type.substr(0, std::min({type.find(":{"), type.find(":INT in"), type.find(":FLOAT in")}));
  result.repeated =
      option.get_expected_max() > 1 || option.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll;
  result.kind = ValueKind::any;
  if (result.words = membersOf(type); !result.words.empty()) {
    result.kind = ValueKind::words;
  } else if (result.value == "KEY=VALUE") {
    result.kind = ValueKind::keys;
  } else if (isOneOf(result.value, {"DIR", "OUT"})) {
    result.kind = ValueKind::folders;
  } else if (isOneOf(result.value, {"SCENE", "IMAGE", "FILE", "PAGE", "NAME=FILE", "KIND=IMAGE"})) {
    result.kind = ValueKind::files;
  }
  return result;
}

void describe(const CLI::App& app, DescribedCommand& result) {
  result.name = app.get_name();
  result.text = app.get_description();
  result.footer = app.get_footer();
  for (const CLI::Option* option : app.get_options({})) result.options.push_back(describedOption(*option));
}

}  // namespace

DescribedProgram described(const CLI::App& app) {
  DescribedProgram program;
  describe(app, program);
  for (const CLI::App* command : app.get_subcommands(std::function<bool(const CLI::App*)>{}))
    describe(*command, program.commands.emplace_back());
  return program;
}

}  // namespace fluidtex::tools
