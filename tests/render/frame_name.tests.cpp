#include "render/frame_name.h"

#include <catch2/catch.hpp>

using namespace fluidtex::render;

TEST_CASE("frame name: numbers come back from their names", "[render]") {
  CHECK(frameName(7) == "0007");
  for (const int frame : {0, 1, 42, 9999, 10000, 2147483647}) CHECK(frameNumber(frameName(frame)) == frame);
}

TEST_CASE("frame name: every other text is none", "[render]") {
  for (const char* text :
       {"", "7", "007", "00007", "-001", "+001", " 0007", "0007 ", "0007.png", "00a7", "99999999999"}) {
    INFO(text);
    CHECK_FALSE(frameNumber(text).has_value());
  }
}
