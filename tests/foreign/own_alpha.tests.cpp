#include "foreign/own_alpha.h"

#include "tests/scratch.h"

#include <catch2/catch.hpp>

#include <cstdint>

using namespace fluidtex::foreign;

namespace {

// The beginning of a BMP whose second header is so long, with a mask of alpha at the mask's place.
std::string bitmapHead(std::uint32_t header, std::uint32_t mask) {
  std::string bytes(14 + 124, '\0');
  for (int i = 0; i < 4; ++i) {
    bytes[std::size_t(14 + i)] = char(header >> (8 * i));
    bytes[std::size_t(14 + 52 + i)] = char(mask >> (8 * i));
  }
  return bytes;
}

bool says(const std::string& bytes, const char* kind) {
  const Scratch scratch;
  std::ofstream(scratch.path / "a", std::ios::binary) << bytes;
  return saysAlpha(scratch.path / "a", kind);
}

}  // namespace

TEST_CASE("own alpha: a BMP has it by a mask in its header, of a length that has one", "[foreign]") {
  CHECK(says(bitmapHead(56, 0xff000000u), "bmp"));
  CHECK(says(bitmapHead(108, 0xff000000u), "bmp"));
  CHECK(says(bitmapHead(124, 0xffu), "bmp"));
  CHECK_FALSE(says(bitmapHead(124, 0), "bmp"));
  // What stands there is behind the earlier headers: colours, or pixels.
  CHECK_FALSE(says(bitmapHead(40, 0xff000000u), "bmp"));
  CHECK_FALSE(says(bitmapHead(52, 0xff000000u), "bmp"));
  CHECK_FALSE(says("BM", "bmp"));
}

TEST_CASE("own alpha: a TGA has it by the bits that its header counts", "[foreign]") {
  std::string bytes(18, '\0');
  CHECK_FALSE(says(bytes, "targa"));
  bytes[17] = char(0x20);  // from the top, which is no alpha
  CHECK_FALSE(says(bytes, "targa"));
  bytes[17] = char(0x28);
  CHECK(says(bytes, "targa"));
  CHECK_FALSE(says("", "targa"));
}

TEST_CASE("own alpha: all other kinds are believed", "[foreign]") {
  CHECK(says("", "png"));
  CHECK(says(bitmapHead(40, 0), "tiff"));
}
