#include "texture/levelset/crossed_cells.h"

#include <catch2/catch.hpp>

#include <random>
#include <tuple>
#include <vector>

using namespace fluidtex::texture;

TEST_CASE("crossed cells: those whose corners differ in sign, x slowest, zero counts as outside") {
  constexpr int kSide = kBlockSide, kPadded = kBlockPadded;
  std::mt19937 random(5);
  for (const int odds : {2, 40, 400}) {  // one negative value in so many
    std::vector<float> values(kPadded * kPadded * kPadded);
    for (float& v : values) v = random() % unsigned(odds) == 0 ? -1.0f : float(random() % 2);
    const auto at = [&](int x, int y, int z) {
      return values.data() + ((x + 1) * kPadded + y + 1) * kPadded + z + 1;
    };
    std::vector<std::tuple<int, int, int>> expected, found;
    for (int x = 0; x < kSide; ++x)
      for (int y = 0; y < kSide; ++y)
        for (int z = 0; z < kSide; ++z) {
          int inside = 0;
          for (int n = 0; n < 8; ++n) inside += *at(x + (n >> 2), y + (n >> 1 & 1), z + (n & 1)) < 0.0f;
          if (inside > 0 && inside < 8) expected.emplace_back(x, y, z);
        }
    forCrossedCells(values.data(), [&](int x, int y, int z, const float* lowest) {
      CHECK(lowest == at(x, y, z));
      found.emplace_back(x, y, z);
    });
    CHECK(found == expected);
  }
}
