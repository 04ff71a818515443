#include "tools/formats/text_stream.h"

#include <catch2/catch.hpp>

#include <sstream>

using namespace fluidtex;

TEST_CASE("text stream: what was put and added comes out in its order, all of it at the end", "[tools]") {
  std::ostringstream out;
  {
    tools::TextStream text(out);
    text.put("{} {:.2f}", 7, 0.5);
    text.add(" {} as it is\n");
    text.put("{{}}");
  }
  CHECK(out.str() == "7 0.50 {} as it is\n{}");
}

TEST_CASE("text stream: no more than a piece is kept, whatever is put", "[tools]") {
  std::ostringstream out;
  std::string expected;
  std::size_t most = 0;
  {
    tools::TextStream text(out);
    for (int n = 0; n < 50000; ++n) {
      text.put("line {}\n", n);
      expected += "line " + std::to_string(n) + "\n";
      most = std::max(most, expected.size() - std::size_t(out.tellp()));
    }
    CHECK(expected.starts_with(out.str()));
  }
  CHECK(out.str() == expected);
  REQUIRE(expected.size() > 500000);
  CHECK(most <= 65536);
  CHECK(most > 60000);  // in pieces, not line by line
}
