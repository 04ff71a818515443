#include "foreign/grid_heads.h"

#include <catch2/catch.hpp>

using namespace fluidtex::foreign;

namespace {

std::vector<GridHead> twoHeads() {
  std::vector<GridHead> heads(2);
  heads[0].name = std::string("vel\0x", 5);
  heads[0].type = "Tree_float_5_4_3_HalfFloat";
  heads[0].gridClass = "staggered";
  heads[0].half = true;
  heads[0].activeVoxels = std::int64_t(1) << 40;
  heads[0].transform.emplace();
  for (std::size_t i = 0; i < 16; ++i) (*heads[0].transform)[i] = 0.1 * double(i) - 0.5;
  heads[1].type = "Tree_vec3s_5_4_3";
  heads[1].readable = heads[1].vectors = true;
  return heads;
}

}  // namespace

TEST_CASE("grid heads: come back as they were", "[foreign]") {
  const std::vector<GridHead> heads = twoHeads(), back = unpacked(packed(heads));
  REQUIRE(back.size() == 2);
  for (std::size_t n = 0; n < 2; ++n) {
    CHECK(back[n].name == heads[n].name);
    CHECK(back[n].type == heads[n].type);
    CHECK(back[n].gridClass == heads[n].gridClass);
    CHECK(back[n].half == heads[n].half);
    CHECK(back[n].readable == heads[n].readable);
    CHECK(back[n].vectors == heads[n].vectors);
    CHECK(back[n].activeVoxels == heads[n].activeVoxels);
    CHECK(back[n].transform == heads[n].transform);
  }
  CHECK(packed({}).empty());
  CHECK(unpacked("").empty());
}

TEST_CASE("grid heads: bytes that end within a head are refused, wherever they do", "[foreign]") {
  const std::vector<GridHead> heads = twoHeads();
  const std::string bytes = packed(heads);
  const std::size_t first = packed({heads[0]}).size();
  for (std::size_t size = 1; size < bytes.size(); ++size) {
    CAPTURE(size);
    if (size == first)
      CHECK(unpacked(bytes.substr(0, size)).size() == 1);
    else
      CHECK_THROWS_AS(unpacked(bytes.substr(0, size)), Unreadable);
  }
  CHECK_THROWS_AS(unpacked(bytes + '\1'), Unreadable);
}

TEST_CASE("grid heads: lengths beyond the end, and what is neither true nor false, are refused",
          "[foreign]") {
  std::string bytes = packed(twoHeads());
  bytes[7] = '\x7f';  // of the name, by now some 2^63
  CHECK_THROWS_AS(unpacked(bytes), Unreadable);
  // Without names: three lengths, then whether it is half, readable and of vectors, a count, and whether
  // there is a transform.
  const std::string plain = packed({GridHead{}});
  const std::size_t lengths = 3 * sizeof(std::size_t);
  for (const std::size_t at : {lengths, lengths + 1, lengths + 2, lengths + 3 + sizeof(std::int64_t)}) {
    CAPTURE(at);
    bytes = plain;
    REQUIRE(at < bytes.size());
    bytes[at] = '\2';
    CHECK_THROWS_AS(unpacked(bytes), Unreadable);
  }
}
