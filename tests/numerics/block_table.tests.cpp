#include "numerics/block_table.h"

#include "numerics/random.h"

#include <catch2/catch.hpp>

#include <map>
#include <set>

using namespace fluidtex;
using openvdb::math::Coord;

TEST_CASE("block table: numbers as a map gives them, for any places in any order", "[block_table]") {
  BlockTable table;
  std::map<Coord, std::uint32_t> expected;
  for (std::uint64_t n = 0; n < 20000; ++n) {
    // A few hundred places, near each other and far away, again and again.
    const auto along = [&](int axis) {
      const std::int32_t near = 8 * (static_cast<std::int32_t>(randomBits(axis, n) % 9) - 4);
      return n % 7 == 0 ? near * 40000000 : near;
    };
    const Coord place(along(0), along(1), along(2));
    const auto [known, isNew] = expected.emplace(place, static_cast<std::uint32_t>(expected.size()));
    CHECK(table.find(place) == (isNew ? BlockTable::kNone : known->second));
    REQUIRE(table.enter(place) == known->second);
  }
  CHECK(table.size() == expected.size());
  for (const auto& [place, number] : expected) REQUIRE(table.find(place) == number);
  CHECK(table.find(Coord(1, 2, 3)) == BlockTable::kNone);
}

TEST_CASE("block table: an empty one holds nothing", "[block_table]") {
  CHECK(BlockTable().find(Coord(0)) == BlockTable::kNone);
  CHECK(BlockTable(1000).size() == 0);
}

TEST_CASE("block table: places in rows and planes share few slots", "[block_table]") {
  // Random hashes of so many places into eight times as many slots leave 94% of them alone.
  for (const int stride : {1, 8, 32, 4096}) {
    std::set<std::size_t> slots;
    int count = 0;
    for (int x = -16; x < 16; ++x) {
      for (int y = -16; y < 16; ++y) {
        for (int z = 0; z < 2; ++z, ++count)
          slots.insert(hashOfPlace(x * stride, y * stride, z * stride) & 16383);
      }
    }
    CHECK(slots.size() > 0.9 * count);
  }
}
