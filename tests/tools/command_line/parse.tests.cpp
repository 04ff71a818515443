// The parser, on a program of its own.
#include "tools/command_line/parse.h"

#include "tools/base/errors.h"

#include <catch2/catch.hpp>

using namespace fluidtex::tools;
using Catch::Contains;
using Catch::StartsWith;

namespace {

struct Values {
  bool loud = false;
  int count = 1;
  double share = 0.5;
  std::optional<double> height;
  std::string shade = "coat", last;
  std::filesystem::path file;
  std::vector<std::string> parts, sets, formats;
};

Program programFor(Values& values) {
  Program program{"tool", "A tool for tests.", "Example:\n  tool make a", "tool 1.2"};
  Command make{"make", "Make it"};
  make.options = {
      {"file", &values.file, "FILE", "What is made", {.required = true}},
      {"parts", &values.parts, "NAME", "Of what"},
      {"-l,--loud", &values.loud, "", "Say more"},
      {"--count", &values.count, "N", "How many", {.least = 1, .most = 9}},
      {"--share", &values.share, "X", "How much", {.least = 0.0, .most = 1.0}},
      {"--height", &values.height, "M", "How high", {.with = "--loud"}},
      {"--shade", &values.shade, "NAME", "Which", {.words = {"coat", "plain"}}},
      {"--last", &values.last, "FILE", "Where", {.ending = ".end"}},
      {"--set", &values.sets, "KEY=VALUE", "Sets a key"},
      {"--format", &values.formats, "NAME", "Which", {.withCommas = true}},
  };
  make.run = [] { return 7; };
  program.commands = {make, {"rest", "Do nothing", {}, "Note:\n  none"}};
  program.commands[1].run = [] { return 0; };
  return program;
}

Asked parsed(const Program& program, std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "tool");
  return parse(program, static_cast<int>(arguments.size()), arguments.data());
}

}  // namespace

TEST_CASE("parse: arguments go where the command's options say", "[tools][command_line]") {
  Values values;
  const Program program = programFor(values);
  const Asked asked = parsed(
      program, {"make",     "a b",  "one",      "two",     "-l",       "--count", "3",     "--share=0.25",
                "--height", "-1.5", "--shade",  "plain",   "--last",   "x.end",   "--set", "a=1",
                "--set",    "b=2",  "--format", "glb,obj", "--format", "vtp"});
  REQUIRE(asked.command == &program.commands[0]);
  CHECK(asked.command->run() == 7);
  CHECK(values.file == "a b");
  CHECK(values.parts == std::vector<std::string>{"one", "two"});
  CHECK(values.loud);
  CHECK(values.count == 3);
  CHECK(values.share == 0.25);
  CHECK(values.height == -1.5);
  CHECK(values.shade == "plain");
  CHECK(values.last == "x.end");
  CHECK(values.sets == std::vector<std::string>{"a=1", "b=2"});
  CHECK(values.formats == std::vector<std::string>{"glb", "obj", "vtp"});
}

TEST_CASE("parse: what is not given stays as it was", "[tools][command_line]") {
  Values values;
  const Program program = programFor(values);
  CHECK(parsed(program, {"make", "a"}).command == &program.commands[0]);
  CHECK_FALSE(values.loud);
  CHECK(values.count == 1);
  CHECK_FALSE(values.height);
  CHECK(values.shade == "coat");
  CHECK(values.sets.empty());
  CHECK(parsed(program, {"rest"}).command == &program.commands[1]);
}

TEST_CASE("parse: one sentence for each thing that does not fit", "[tools][command_line]") {
  Values values;
  const Program program = programFor(values);
  const auto told = [&](const std::vector<const char*>& arguments) -> std::string {
    try {
      parsed(program, arguments);
    } catch (const UsageError& error) {
      return error.what();
    }
    return "nothing";
  };
  CHECK(told({"mkae"}) == "mkae: no such command; did you mean make?");
  CHECK_THAT(told({"zzzzzz"}), StartsWith("zzzzzz: no such command; there are ") && Contains("rest"));
  const std::string advice = "; `tool help make` says what can be given";
  CHECK(told({"make"}) == "file is required" + advice);
  for (const auto& [name, value] : {std::pair{"--count", "0"},
                                    {"--count", "10"},
                                    {"--count", "a"},
                                    {"--share", "1.5"},
                                    {"--shade", "glass"},
                                    {"--last", "x.png"},
                                    {"--height", "2"},
                                    {"--nothing", "1"}}) {
    const std::string sentence = told({"make", "a", name, value});
    INFO(sentence);
    CHECK_THAT(sentence, Contains(name) && Catch::EndsWith(advice));
  }
  CHECK_THAT(told({}), StartsWith("a subcommand is required") && Contains("`tool help`"));
}

TEST_CASE("parse: help and the version are texts", "[tools][command_line]") {
  Values values;
  const Program program = programFor(values);
  CHECK(parsed(program, {"--version"}).text == "tool 1.2\n");
  const Asked help = parsed(program, {"make", "--help"});
  CHECK(help.command == nullptr);
  CHECK(help.text == helpOf(program, "make"));
  CHECK_THAT(help.text, Contains("Usage: tool make") && Contains("--count N:INT in [1 - 9]") &&
                            Contains("--shade NAME:{coat,plain}") && Contains("-h,--help"));
  CHECK_THAT(helpOf(program, ""), Contains("A tool for tests.") && Contains("tool make a"));
  CHECK_THAT(helpOf(program, "rest"), Contains("Note:"));
  CHECK(values.file.empty());
}
