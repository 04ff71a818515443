// The command line as plain values, read off the parser: what --help tells is what the manual page and the
// shells' completion are made of.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace fluidtex::tools {

// What a value of an option is, for those who offer some.
enum class ValueKind { none, any, words, keys, files, folders };

struct DescribedOption {
  std::vector<std::string> names;  // "-V", "--version"; none: it goes by its place
  std::string value;               // "N", "DIR"; empty: it takes none
  std::string text;
  ValueKind kind = ValueKind::none;
  std::vector<std::string> words;  // with ValueKind::words
  bool required = false, repeated = false;
  bool byPlace() const { return names.empty(); }
};

struct DescribedCommand {
  std::string name, text;
  std::string footer;  // examples: lines that begin with two spaces
  std::vector<DescribedOption> options;
};

struct DescribedProgram : DescribedCommand {
  std::vector<DescribedCommand> commands;
};

DescribedProgram described(const CLI::App& app);

}  // namespace fluidtex::tools
