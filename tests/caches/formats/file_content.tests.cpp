#include "caches/formats/file_content.h"

#include "tests/caches/formats/written_bytes.h"

#include <catch2/catch.hpp>

using namespace fluidtex::caches;
using Catch::Matchers::Contains;
using Catch::Matchers::EndsWith;
using Catch::Matchers::Equals;

TEST_CASE("file content: all bytes, as they are", "[caches]") {
  std::string bytes;
  for (int n = 0; n < 300; ++n) bytes += char(n);
  bytes += "\r\n\n\r";
  const Written file("a.bin", bytes);
  CHECK(bytesOf(file.path) == bytes);
  CHECK(contentOf(file.path) == bytes);
  CHECK(unpacked(file.path, "water") == "water");
}

TEST_CASE("file content: what gzip has packed is unpacked, whatever the file's name", "[caches]") {
  const std::string whole = gzipped("water");
  const Written file("a.ply", whole);
  CHECK(bytesOf(file.path) == whole);
  CHECK(contentOf(file.path) == "water");
  CHECK_THROWS_AS(unpacked(file.path, whole.substr(0, whole.size() - 1)), FormatError);
  CHECK_THROWS_WITH(unpacked(file.path, whole.substr(0, whole.size() - 1)),
                    Contains(file.path.string() + ": ") && Contains("cut short"));
}

TEST_CASE("file content: what cannot be read is told with the file's name", "[caches]") {
  const Written file("a.ply", "");
  const auto folder = file.scratch.path / "folder";
  std::filesystem::create_directory(folder);
  CHECK_THROWS_AS(bytesOf(file.path), FormatError);
  CHECK_THROWS_WITH(contentOf(file.path), Contains(file.path.string() + ": the file is empty"));
  CHECK_THROWS_AS(bytesOf(folder), FormatError);
  CHECK_THROWS_WITH(bytesOf(folder), EndsWith("folder: not a file"));
  CHECK_THROWS_AS(bytesOf(file.scratch.path / "none"), FormatError);
  CHECK_THROWS_WITH(bytesOf(file.scratch.path / "none"), EndsWith("none: no such file"));
  CHECK_THROWS_AS(fail("a.ply", "is wet"), FormatError);
  CHECK_THROWS_WITH(fail("a.ply", "is wet"), Equals("a.ply: is wet"));
}
