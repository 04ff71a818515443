#include "caches/formats/gzip.h"

#include "tests/caches/formats/checks.h"
#include "tests/caches/formats/pyramid_files.h"

#include <limits>

using namespace fluidtex::caches;
using Catch::Matchers::Contains;

TEST_CASE("gzip: a file is one by its first two bytes", "[caches]") {
  CHECK(isGzip("\x1f\x8b"));
  CHECK(isGzip(gzipped("water")));
  CHECK_FALSE(isGzip(""));
  CHECK_FALSE(isGzip("\x1f"));
  CHECK_FALSE(isGzip("\x8b\x1f"));
  CHECK_FALSE(isGzip(zlibbed("water")));
}

TEST_CASE("gzip: what was packed, in several members, with zeros behind", "[caches]") {
  std::string bytes;
  for (std::uint32_t n = 0; n < 100000; ++n) put(bytes, n * n);
  CHECK(unpackedGzip(gzipped(bytes)) == bytes);
  CHECK(unpackedGzip(gzipped(bytes) + gzipped("more") + std::string(512, '\0')) == bytes + "more");
  CHECK(unpackedGzip(gzipped("")).empty());
  // Of zeros, which pack best: far more than what the first guess is.
  CHECK(unpackedGzip(gzipped(std::string(10000000, '\0'))) == std::string(10000000, '\0'));
  CHECK(canHold(gzipped(std::string(10000000, '\0')).size(), 10000000));
}

TEST_CASE("gzip: damage is found, be it only in the last bytes", "[caches]") {
  const std::string good = gzipped(bobj(true));
  for (std::size_t length = 2; length < good.size(); ++length)
    REQUIRE_THAT(refusalOf("a.bobj.gz", good.substr(0, length)), Contains("cut short"));
  std::string bad = good;
  bad[bad.size() - 6] ^= 1;  // of the checksum
  CHECK_THAT(refusalOf("a.bobj.gz", bad), Contains("damaged"));
  CHECK_THAT(refusalOf("a.bobj.gz", good + "x"), Contains("bytes behind"));
}

TEST_CASE("gzip: cut anywhere behind the first of two members, or changed in the second", "[caches]") {
  const std::string first = gzipped("water"), both = first + gzipped("more water");
  REQUIRE(unpackedGzip(both) == "watermore water");
  for (std::size_t length = first.size() + 1; length < both.size(); ++length) {
    CAPTURE(length);
    CHECK_THROWS_AS(unpackedGzip(both.substr(0, length)), std::runtime_error);
  }
  CHECK_THROWS_WITH(unpackedGzip(""), Contains("cut short"));
  std::string bad = both;
  bad[bad.size() - 6] ^= 1;  // of the checksum
  CHECK_THROWS_WITH(unpackedGzip(bad), Contains("damaged"));
}

TEST_CASE("gzip: a zlib stream holds just as many bytes as it should", "[caches]") {
  std::string bytes;
  for (int n = 0; n < 1000; ++n) put(bytes, std::int32_t(n * n));
  const std::string stream = zlibbed(bytes);
  std::string result(bytes.size(), '\0');
  unpackZlib(stream, result.data(), result.size());
  CHECK(result == bytes);
  std::string larger(bytes.size() + 1, '\0');
  CHECK_THROWS_WITH(unpackZlib(stream, larger.data(), bytes.size() + 1), Contains("packed by zlib"));
  CHECK_THROWS_WITH(unpackZlib(stream, larger.data(), bytes.size() - 1), Contains("packed by zlib"));
  CHECK_THROWS(unpackZlib(stream.substr(0, stream.size() - 1), result.data(), result.size()));
  std::string bad = stream;
  bad.back() ^= 1;  // of the checksum
  CHECK_THROWS(unpackZlib(bad, result.data(), result.size()));
  CHECK_THROWS(unpackZlib(gzipped(bytes), result.data(), result.size()));
  CHECK_NOTHROW(unpackZlib(zlibbed(""), result.data(), 0));
}

TEST_CASE("gzip: nothing holds more than 1032 times as much, and the largest numbers are compared",
          "[caches]") {
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();
  CHECK(canHold(1000, 1032000));
  CHECK_FALSE(canHold(1000, 1033032));
  CHECK(canHold(kMost, kMost));
  CHECK(canHold(kMost / 1032, kMost));
  CHECK_FALSE(canHold(kMost / 1032 - 1, kMost));
}
