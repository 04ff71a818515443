#include "tools/base/fingerprint.h"

#include "tests/scratch.h"

#include <catch2/catch.hpp>

#include <fstream>
#include <system_error>

using namespace fluidtex::tools;

TEST_CASE("fingerprint: a file's bytes and the hash of its content, wherever it lies", "[tools]") {
  const Scratch scratch;
  // Longer than what is read at once.
  std::string content;
  for (int n = 0; n < 300000; ++n) content += std::to_string(n);
  REQUIRE(content.size() > (1 << 20));
  std::ofstream(scratch.path / "a", std::ios::binary) << content;
  std::ofstream(scratch.path / "b", std::ios::binary) << content;
  const Fingerprint a = fingerprintOf(scratch.path / "a");
  CHECK(a.bytes == content.size());
  CHECK(a.hash == hashOf(content));
  CHECK(a.hash.size() == 32);
  CHECK(fingerprintOf(scratch.path / "b") == a);
  content[1000000] ^= 1;
  std::ofstream(scratch.path / "b", std::ios::binary) << content;
  CHECK_FALSE(fingerprintOf(scratch.path / "b") == a);
}

TEST_CASE("fingerprint: XXH3's published value of no bytes, and a missing file is named", "[tools]") {
  CHECK(hashOf("") == "99aa06d3014798d86001c324468d497f");
  CHECK_THROWS_AS(fingerprintOf("/nowhere/scene.toml"), std::system_error);
  CHECK_THROWS_WITH(fingerprintOf("/nowhere/scene.toml"), Catch::Contains("/nowhere/scene.toml"));
}
