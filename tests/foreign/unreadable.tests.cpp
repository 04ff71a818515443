#include "foreign/unreadable.h"

#include <catch2/catch.hpp>

using fluidtex::foreign::asClause;

TEST_CASE("unreadable: a library's words become a part of one sentence", "[foreign]") {
  CHECK(asClause("Not a PNG file.") == "Not a PNG file");
  CHECK(asClause("  Bad header.\nTry\tagain. \n") == "Bad header; Try again");
  CHECK(asClause("\x1b[31mred\x1b[0m") == "[31mred [0m");
  CHECK(asClause("").empty());
  const std::string much = asClause(std::string(1 << 20, 'a'));
  CHECK(much.size() < 310);
  // No letter of two bytes is cut.
  std::string umlauts;
  while (umlauts.size() < 1000) umlauts += "\xc3\xa4";
  const std::string cut = asClause("a" + umlauts);
  CHECK(cut.ends_with("\xc3\xa4..."));
}
