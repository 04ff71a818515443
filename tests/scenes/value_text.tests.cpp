#include "scenes/value_text.h"

#include "scenes/document.h"

#include <catch2/catch.hpp>

#include <cmath>

namespace fluidtex::scenes {

TEST_CASE("value text: numbers have ten digits at most, and no zeros behind them", "[scenes]") {
  CHECK(written(3.0) == "3");
  CHECK(written(-9.81) == "-9.81");
  CHECK(written(1.0 / 3.0) == "0.3333333333");
  CHECK(written(50e6) == "50000000");
  CHECK(written(1e-9) == "1e-09");
  CHECK(written(Vec3d(0.0, -0.5, 1e10)) == "[0, -0.5, 1e+10]");
  CHECK(written(std::vector<int>{33, 17, 9}) == "[33, 17, 9]");
  CHECK(written(std::vector<int>{}) == "[]");
}

TEST_CASE("value text: what is written is read from a scene file as the same number", "[scenes]") {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double value : {0.0, 0.1, -2.5, 1e-9, 1e10, 6.02214076e23, infinity, -infinity}) {
    Faults faults;
    const Node document = readDocument("x = " + written(value), "s.toml", faults);
    REQUIRE(faults.empty());
    const Node& read = find(std::get<Table>(document.value), "x")->node;
    const auto* whole = std::get_if<std::int64_t>(&read.value);
    CHECK((whole ? double(*whole) : std::get<double>(read.value)) == value);
  }
}

TEST_CASE("value text: a range is told by the limits that it has", "[scenes]") {
  CHECK(rangeOf(kAny).empty());
  CHECK(rangeOf(kPositive) == "above 0");
  CHECK(rangeOf(kNotNegative) == "0 or more");
  CHECK(rangeOf(kShare) == "from 0 to 1");
  CHECK(rangeOf({.low = 0.5, .high = 2.0, .aboveLow = true}) == "above 0.5 and up to 2");
  CHECK(rangeOf({.high = 90.0}) == "up to 90");
}

TEST_CASE("value text: limits are within their range, unless it begins above the lower one", "[scenes]") {
  const Limits closed{.low = -1.0, .high = 2.0}, above{.low = -1.0, .high = 2.0, .aboveLow = true};
  const double before = std::nextafter(-1.0, -2.0), behind = std::nextafter(2.0, 3.0);
  CHECK(within(closed, -1.0));
  CHECK_FALSE(within(above, -1.0));
  CHECK(within(above, std::nextafter(-1.0, 0.0)));
  for (const Limits& limits : {closed, above}) {
    CHECK(within(limits, 2.0));
    CHECK_FALSE(within(limits, before));
    CHECK_FALSE(within(limits, behind));
  }
}

TEST_CASE("value text: what is not finite is within no limits, but for plus infinity where they allow it",
          "[scenes]") {
  const double infinity = std::numeric_limits<double>::infinity(), nan = std::nan("");
  const Limits forever{.infinite = true};
  CHECK_FALSE(within(kAny, infinity));
  CHECK_FALSE(within(kAny, -infinity));
  CHECK_FALSE(within(kAny, nan));
  CHECK(within(forever, infinity));
  CHECK_FALSE(within(forever, -infinity));
  CHECK_FALSE(within(forever, nan));
}

}  // namespace fluidtex::scenes
