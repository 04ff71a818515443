#include "texture/exemplar/window_size.h"

#include <catch2/catch.hpp>

using namespace fluidtex::texture;

namespace {

Image sized(int width, int height) {
  return {width, height, 1, std::vector<float>(std::size_t(width) * std::size_t(height))};
}

}  // namespace

TEST_CASE("window size: the asked width where it leaves a choice of places, else the largest that does",
          "[texture]") {
  CHECK(fittingWindow(sized(64, 64), false, 9) == 9);
  CHECK(fittingWindow(sized(16, 64), false, 33) == 9);  // 5/8 of 16 is 10, the odd width below 9
  CHECK(fittingWindow(sized(64, 16), true, 33) == 15);  // the whole side, odd
  CHECK(fittingWindow(sized(17, 17), true, 33) == 17);
  CHECK(fittingWindow(sized(5, 5), false, 9) == kSmallestWindow);
  CHECK(fittingWindow(sized(4, 4), false, 9) < kSmallestWindow);
}
