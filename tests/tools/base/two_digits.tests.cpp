#include "tools/base/two_digits.h"

#include <catch2/catch.hpp>

using namespace fluidtex;

TEST_CASE("two digits: numbers are written as people write them", "[tools]") {
  CHECK(tools::twoDigits(0.0) == "0");
  CHECK(tools::twoDigits(0.254) == "0.25");
  CHECK(tools::twoDigits(9.96) == "10");
  CHECK(tools::twoDigits(10.4) == "10");
  CHECK(tools::twoDigits(481.0) == "480");
  CHECK(tools::twoDigits(996.0) == "1000");
  CHECK(tools::twoDigits(128000.0) == "130000");
}

TEST_CASE("two digits: no more than two, whatever the size, and no exponent", "[tools]") {
  CHECK(tools::twoDigits(0.00123) == "0.0012");
  CHECK(tools::twoDigits(4.84) == "4.8");
  CHECK(tools::twoDigits(5.0) == "5");
  CHECK(tools::twoDigits(9.94) == "9.9");
  CHECK(tools::twoDigits(99.4) == "99");
  CHECK(tools::twoDigits(99.6) == "100");
  CHECK(tools::twoDigits(1e6) == "1000000");
  CHECK(tools::twoDigits(123456789.0) == "120000000");
  CHECK(tools::twoDigits(2.5e15) == "2500000000000000");
}
