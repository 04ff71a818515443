#include "tools/command_line/command.h"

#include <catch2/catch.hpp>

using namespace fluidtex::tools;

TEST_CASE("command: names of options", "[tools][command_line]") {
  using Names = std::vector<std::string>;
  std::vector<std::string> many;
  bool flag = false;
  const Option parts{"parts", &many, "NAME", "Of what"}, loud{"-l,--loud", &flag, "", "Say more"};
  CHECK(namesOf(loud) == Names{"-l", "--loud"});
  CHECK(namesOf(parts).empty());
  CHECK(isByPlace(parts));
  CHECK_FALSE(isByPlace(loud));
  CHECK(isRepeated(parts));
  CHECK_FALSE(isRepeated(loud));
}

TEST_CASE("command: options are joined and found by name", "[tools][command_line]") {
  bool flag = false;
  Command command{"make", "Make it", {{"--one", &flag, "", "1"}}};
  append(command.options, {{"--two", &flag, "", "2"}, {"--three", &flag, "", "3"}});
  REQUIRE(command.options.size() == 3);
  named(command.options, "--two").text = "other";
  CHECK(command.options[1].text == "other");
  const std::vector<Option> all = allOptions(command);
  REQUIRE(all.size() == 4);
  CHECK(all.front().name == "-h,--help");
  CHECK(all.back().name == "--three");
  CHECK(allOptions(Program{"tool", "", "", "", {}}).back().name == "-V,--version");
}
