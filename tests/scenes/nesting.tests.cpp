#include "scenes/nesting.h"

#include "tests/scenes/repeated.h"

#include <catch2/catch.hpp>

namespace fluidtex::scenes {

TEST_CASE("damaged text: nesting is counted where TOML nests", "[scenes]") {
  CHECK_FALSE(tooDeep(""));
  CHECK_FALSE(tooDeep("a.b = [[1.5, 2.5], [3.5]] # " + repeated("a.", 100)));
  CHECK_FALSE(tooDeep("a = \"" + repeated(".", 100) + "\"\nb = '" + repeated("[", 100) + "'"));
  CHECK_FALSE(
      tooDeep("a = \"\"\"\n" + repeated(".", 100) + "\n\"quoted\" \\\"\"\"\" # " + repeated(".", 100)));
  CHECK_FALSE(tooDeep("a = [" + repeated("1.5, ", 1000) + "1]"));
  CHECK_FALSE(tooDeep(repeated("a.b = 1\n", 1000)));
  CHECK_FALSE(tooDeep("a = " + repeated("[", 64) + repeated("]", 64)));
  CHECK(tooDeep("a = " + repeated("[", 65) + repeated("]", 65)));
  const auto place = tooDeep("a = 1\nb = \"\"\"\n\n\"\"\"\n " + repeated("a.", 65) + "a = 1");
  REQUIRE(place);
  CHECK(place->line == 5);
  CHECK(place->column == 1 + 2 * 65);
}

TEST_CASE("nesting: brackets and parts of keys count together, up to the deepest", "[scenes]") {
  const auto nested = [](int dots, int brackets) {
    return tooDeep(repeated("a.", dots) + "a = " + repeated("[", brackets));
  };
  CHECK(kDeepest == 64);
  CHECK_FALSE(nested(64, 0));
  CHECK(nested(65, 0));
  CHECK_FALSE(nested(30, 34));
  CHECK(nested(30, 35));
  // Inside of a table that is written in a line, from where that lies.
  CHECK_FALSE(tooDeep("a.b = { c.d.e = { " + repeated("f.", 59) + "f = 1 } }"));
  CHECK(tooDeep("a.b = { c.d.e = { " + repeated("f.", 60) + "f = 1 } }"));
}

TEST_CASE("nesting: what was closed counts no more, and brackets closed too often count nothing",
          "[scenes]") {
  CHECK_FALSE(tooDeep(repeated("[]", 1000)));
  CHECK_FALSE(tooDeep(repeated("]", 100) + repeated("[", 64)));
  CHECK(tooDeep(repeated("]", 100) + repeated("[", 65)));
}

TEST_CASE("nesting: the place is that of the first thing that is too deep, from 1", "[scenes]") {
  const auto first = tooDeep(repeated("[", 200));
  REQUIRE(first);
  CHECK(first->line == 1);
  CHECK(first->column == 65);
  // A string that is not closed ends with its line.
  const auto behind = tooDeep("a = \"" + repeated("[", 100) + "\nb = " + repeated("[", 65));
  REQUIRE(behind);
  CHECK(behind->line == 2);
  CHECK(behind->column == 4 + 65);
}

}  // namespace fluidtex::scenes
