#include "tools/command_line/command.h"

#include <algorithm>
#include <iterator>
#include <sstream>
#include <utility>

namespace fluidtex::tools {

void append(std::vector<Option>& options, std::vector<Option> more) {
  std::move(more.begin(), more.end(), std::back_inserter(options));
}

Option& named(std::vector<Option>& options, const std::string& name) {
  return *std::find_if(options.begin(), options.end(),
                       [&](const Option& option) { return option.name == name; });
}

std::vector<Option> allOptions(const Command& command) {
  std::vector<Option> options{kHelpOption};
  append(options, command.options);
  return options;
}

std::vector<Option> allOptions(const Program&) {
  return {kHelpOption, kVersionOption};
}

bool isByPlace(const Option& option) {
  return !option.name.starts_with('-');
}

bool isRepeated(const Option& option) {
  return std::holds_alternative<std::vector<std::string>*>(option.target);
}

std::vector<std::string> namesOf(const Option& option) {
  std::vector<std::string> names;
  if (isByPlace(option)) return names;
  std::istringstream all(option.name);
  for (std::string name; std::getline(all, name, ',');) names.push_back(name);
  return names;
}

}  // namespace fluidtex::tools
