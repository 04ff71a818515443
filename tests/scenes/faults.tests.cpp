#include "scenes/faults.h"

#include <catch2/catch.hpp>

namespace fluidtex::scenes {

TEST_CASE("edit distance: counts what must be changed", "[scenes]") {
  CHECK(editDistance("", "") == 0);
  CHECK(editDistance("windows", "windows") == 0);
  CHECK(editDistance("", "abc") == 3);
  CHECK(editDistance("window", "windows") == 1);   // one more
  CHECK(editDistance("windwos", "windows") == 1);  // two swapped
  CHECK(editDistance("Windows", "windows") == 0);  // capitals do not count
  CHECK(editDistance("kitten", "sitting") == 3);
}

TEST_CASE("edit distance: is symmetric and never more than the longer word", "[scenes]") {
  const std::vector<std::string> words = {"", "a", "from", "until", "resolution", "soft_constraint", "turn"};
  for (const std::string& a : words) {
    for (const std::string& b : words) {
      CHECK(editDistance(a, b) == editDistance(b, a));
      CHECK(editDistance(a, b) <= int(std::max(a.size(), b.size())));
    }
  }
}

TEST_CASE("nearest name: only one that is near enough", "[scenes]") {
  const std::vector<std::string> names = {"size", "resolution", "samples"};
  CHECK(nearestName("sise", names) == "size");
  CHECK(nearestName("resolutoin", names) == "resolution");
  CHECK(nearestName("sample", names) == "samples");
  CHECK(nearestName("depth_of_field", names).empty());
  CHECK(nearestName("x", {}).empty());
}

TEST_CASE("faults: in order of layer, line and column, each once", "[scenes]") {
  Faults faults;
  const auto origin = [](int layer, int line, int column, const std::string& where) {
    return Origin{layer, line, column, where, ""};
  };
  faults.add(origin(2, 1, 1, "--exemplar x"), "e", "wrong", "right");
  faults.add(origin(0, 9, 1, "f:9:1"), "d", "wrong", "right");
  faults.add(origin(1, 1, 1, "--set x"), "c", "wrong", "right");
  faults.add(origin(0, 2, 7, "f:2:7"), "b", "wrong", "right");
  faults.add(origin(0, 2, 3, "f:2:3"), "a", "two\nlines", "right");
  faults.add(origin(0, 9, 1, "f:9:1"), "d", "wrong", "right");
  CHECK(faults.lines() ==
        std::vector<std::string>{"f:2:3: error: a: two lines; right", "f:2:7: error: b: wrong; right",
                                 "f:9:1: error: d: wrong; right", "--set x: error: c: wrong; right",
                                 "--exemplar x: error: e: wrong; right"});
}

TEST_CASE("faults: a key is clean if nothing at or below it is wrong", "[scenes]") {
  Faults faults;
  faults.add({}, "liquid.0.box.max", "wrong", "right");
  CHECK_FALSE(faults.clean("liquid"));
  CHECK_FALSE(faults.clean("liquid.0.box.max"));
  CHECK(faults.clean("liquid.0.box.min"));
  CHECK(faults.clean("liquid.0.bo"));
}

TEST_CASE("damaged text: letters of several bytes are not cut", "[scenes]") {
  CHECK(shortened("short", 10) == "short");
  std::string umlauts;
  while (umlauts.size() < 100) umlauts += "\xc3\xa4";
  for (std::size_t most = 10; most < 16; ++most) {
    const std::string cut = shortened(umlauts, most);
    CHECK(cut.size() <= most + 5);
    const std::size_t dots = cut.find(" ... ");
    REQUIRE(dots != cut.npos);
    CHECK(dots % 2 == 0);
    CHECK((cut.size() - dots - 5) % 2 == 0);
  }
}

}  // namespace fluidtex::scenes
