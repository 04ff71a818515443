// The command line as plain values: what the parser takes is what --help, the manual page and the shells'
// completion tell of.
#pragma once

#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace fluidtex::tools {

// Where an option's value goes. bool: it takes none. A vector: an option with a name may be repeated, of one
// that goes by its place there may be several.
using Target = std::variant<bool*, int*, double*, std::string*, std::filesystem::path*,
                            std::optional<double>*, std::vector<std::string>*>;

// What an option takes.
struct Takes {
  bool required = false;
  std::vector<std::string> words = {};                      // these only; empty: any
  double least = -std::numeric_limits<double>::infinity();  // of a number
  double most = std::numeric_limits<double>::infinity();
  std::string ending = {};  // that a file's name must have
  bool withCommas = false;  // several at once
  std::string with = {};    // the option without which it means nothing
};

struct Option {
  std::string name;   // "--out"; "-V,--version"; without hyphens: it goes by its place
  Target target;      // lives as long as the option's command
  std::string value;  // what --help calls its value, "N", "DIR"; empty: it takes none
  std::string text;
  Takes takes = {};
};

struct Command {
  std::string name, text;
  std::vector<Option> options = {};
  std::string footer = {};             // examples: lines that begin with two spaces
  std::function<int()> run = nullptr;  // once the targets hold what was given; returns the exit code
};

// version: what --version prints.
struct Program {
  std::string name, text, footer, version;
  std::vector<Command> commands = {};
};

// What every command takes, and the program without one; the parser itself answers them.
inline const Option kHelpOption{"-h,--help", static_cast<bool*>(nullptr), "",
                                "Print this help message and exit"};
inline const Option kVersionOption{"-V,--version", static_cast<bool*>(nullptr), "",
                                   "Print the version and exit"};

// Adds options to those of a command.
void append(std::vector<Option>& options, std::vector<Option> more);

// The option of that name; it must be there.
Option& named(std::vector<Option>& options, const std::string& name);

// Its own, and before them those that all commands have; of a program those without a command.
std::vector<Option> allOptions(const Command& command);
std::vector<Option> allOptions(const Program& program);

bool isByPlace(const Option& option);
bool isRepeated(const Option& option);
// "-V", "--version"; none of one that goes by its place.
std::vector<std::string> namesOf(const Option& option);

}  // namespace fluidtex::tools
