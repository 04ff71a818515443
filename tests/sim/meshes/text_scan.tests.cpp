#include "sim/meshes/text_scan.h"

#include <catch2/catch.hpp>

using namespace fluidtex::sim;

TEST_CASE("text scan: words between blanks and line ends, then none", "[sim]") {
  std::string_view text = "  f 1/2\t3\r\n#\v4 ";
  for (const char* word : {"f", "1/2", "3", "#", "4", "", ""}) CHECK(takeWord(text) == word);
}

TEST_CASE("text scan: lines end in any of three ways, and may be empty", "[sim]") {
  std::string_view text = "a\nb\r\n\rc";
  for (const char* line : {"a", "b", "", "c"}) CHECK(takeLine(text) == line);
  CHECK(text.empty());
  CHECK(takeLine(text).empty());
}

TEST_CASE("text scan: numbers are whole words, and too large ones infinite", "[sim]") {
  double number = 0.0;
  const auto parse = [&](std::string_view word) { return parseNumber(word, number); };
  CHECK((parse("+1.5e-3") && number == 1.5e-3));
  CHECK((parse("-7") && number == -7.0));
  CHECK((parse("1e999") && number == std::numeric_limits<double>::infinity()));
  CHECK((parse("-1e999") && number == -std::numeric_limits<double>::infinity()));
  CHECK((parse("1e-999") && number == 0.0));
  for (const char* word : {"", "+", "1x", "0,5", "x", "1 "}) CHECK_FALSE(parse(word));
}

TEST_CASE("text scan: words in messages are short and can be printed", "[sim]") {
  CHECK(inQuotes("a b") == "'a b'");
  CHECK(inQuotes("a\x01\xff") == "'a?\?'");
  CHECK(inQuotes(std::string(41, 'x')) == "'" + std::string(40, 'x') + "...'");
  CHECK(inQuotes(std::string(40, 'x')) == "'" + std::string(40, 'x') + "'");
  CHECK(inLowerCase("V Foo9\xC4") == "v foo9\xC4");
}

TEST_CASE("text scan: a mark is taken off, UTF-16 refused", "[sim]") {
  CHECK(withoutMark("\xEF\xBB\xBFv 1") == "v 1");
  CHECK(withoutMark("v 1") == "v 1");
  CHECK_THROWS_AS(withoutMark("\xFF\xFEv"), std::runtime_error);
  CHECK_THROWS_AS(withoutMark("\xFE\xFFv"), std::runtime_error);
}
