#include "caches/formats/base64.h"

#include "tests/caches/formats/pyramid_files.h"

#include <catch2/catch.hpp>

using namespace fluidtex::caches;
using Catch::Matchers::Contains;

TEST_CASE("base64: RFC 4648, 10, in pieces and with line ends", "[caches]") {
  const std::pair<const char*, const char*> kVectors[] = {{"f", "Zg=="},         {"fo", "Zm8="},
                                                          {"foo", "Zm9v"},       {"foob", "Zm9vYg=="},
                                                          {"fooba", "Zm9vYmE="}, {"foobar", "Zm9vYmFy"}};
  for (const auto& [bytes, text] : kVectors) {
    CHECK(fromBase64(text, std::string(bytes).size()) == bytes);
    CHECK(base64Of(bytes) == text);
    CHECK_THROWS_WITH(fromBase64(text, std::string(bytes).size() + 1), Contains("in base64"));
  }
  CHECK(fromBase64(" Zg==\nZm8=\tZm9v ", 6) == "ffofoo");
  CHECK_THROWS(fromBase64("Zm9*", 3));
  CHECK_THROWS(fromBase64("=m9v", 3));
  CHECK_THROWS(fromBase64("Zm=v", 3));
}

TEST_CASE("base64: each byte in each of the three places of a group", "[caches]") {
  for (const std::string before : {"", "a", "ab"}) {
    std::string bytes = before;
    for (int n = 0; n < 256; ++n) bytes += char(n);
    CHECK(fromBase64(base64Of(bytes), bytes.size()) == bytes);
  }
  CHECK(fromBase64("+/+/", 3) == "\xfb\xff\xbf");
}

TEST_CASE("base64: as many bytes as are asked for, whatever follows them", "[caches]") {
  CHECK(fromBase64("Zm9vYmFy", 4) == "foob");
  CHECK(fromBase64("Zm9v*", 3) == "foo");
  CHECK(fromBase64("*", 0).empty());
  CHECK_THROWS_WITH(fromBase64("Zm9v*Zm9v", 4), Contains("has 3 of the 4 bytes"));
  CHECK_THROWS_WITH(fromBase64("Zm9vYm", 4), Contains("has 3 of the 4 bytes"));
  CHECK_THROWS_WITH(fromBase64("Zg=v", 1), Contains("has 0 of the 1 bytes"));
  CHECK_THROWS_WITH(fromBase64("", std::size_t(-1)), Contains("has 0 of the"));
}
