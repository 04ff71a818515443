#include "texture/loops/morton.h"

#include <catch2/catch.hpp>

#include <set>

using namespace fluidtex::texture;

TEST_CASE("morton: bits of x, y and z alternate, and cubes of a power of two are in one piece") {
  const std::uint64_t corner = mortonCode(0, 0, 0);
  CHECK(mortonCode(0, 0, 1) == corner + 1);
  CHECK(mortonCode(0, 1, 0) == corner + 2);
  CHECK(mortonCode(1, 0, 0) == corner + 4);
  CHECK(mortonCode(-1, -1, -1) < corner);
  CHECK(mortonCode(-(1 << 20), -(1 << 20), -(1 << 20)) == 0);
  CHECK(mortonCode((1 << 20) - 1, (1 << 20) - 1, (1 << 20) - 1) == 0x7fffffffffffffffULL);
  std::set<std::uint64_t> codes;
  for (int n = 0; n < 512; ++n) codes.insert(mortonCode(8 + (n >> 6), -16 + ((n >> 3) & 7), n & 7));
  CHECK(codes.size() == 512);
  CHECK(*codes.rbegin() - *codes.begin() == 511);
}
