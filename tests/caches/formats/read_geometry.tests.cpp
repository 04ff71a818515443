#include "tests/caches/formats/checks.h"
#include "tests/caches/formats/pyramid_files.h"

#include "caches/formats/base64.h"
#include "caches/formats/gzip.h"

#include <limits>

using namespace fluidtex::caches;
using Catch::Matchers::Contains;

TEST_CASE("readGeometry: files are told by their endings", "[caches]") {
  for (const char* name : {"a.ply", "a.obj", "a.stl", "a.vtp", "a.vtk", "a.bobj", "fluid_mesh_0001.bobj.gz",
                           "a.bgeo", "a.b.PLY", "a.bhclassic"})
    CHECK(isGeometryFile(name));
  for (const char* name : {"a.bgeo.sc", "a.abc", "a.vdb", "a.gz", "ply", ".ply", "a.ply.tmp", "a.vtu", ""})
    CHECK_FALSE(isGeometryFile(name));
}

TEST_CASE("readGeometry: of formats that are not read it says how to write one that is", "[caches]") {
  for (const char* name : {"a.bgeo.sc", "a.geo", "a.sim"}) {
    CHECK_THAT(adviceFor(name), Contains("Houdini") && Contains(".vdb"));
    CHECK_THAT(refusalOf(name, "scf1"), Contains(adviceFor(name)));
  }
  CHECK_THAT(adviceFor("a.AUR"), Contains("Phoenix") && Contains(".vdb"));
  CHECK_THAT(adviceFor("a.bif"), Contains("Bifrost") && Contains(".vdb"));
  CHECK_THAT(adviceFor("a.abc"), Contains("Alembic") && Contains(".ply"));
  for (const char* name : {"a.usd", "a.usda", "a.usdc", "a.usdz"})
    CHECK_THAT(adviceFor(name), Contains("USD") && Contains(".ply"));
  CHECK_THAT(adviceFor("a.vtu"), Contains(".vtp"));
  CHECK(adviceFor("a.ply").empty());
  CHECK_THAT(refusalOf("a.xyz", "1 2 3"), Contains("expected .ply, .obj"));
}

TEST_CASE("readGeometry: a missing file, a folder, an empty file", "[caches]") {
  const Scratch scratch;
  CHECK_THROWS_WITH(readGeometry(scratch.path / "a.ply"), Contains("a.ply: no such file"));
  std::filesystem::create_directory(scratch.path / "b.ply");
  CHECK_THROWS_WITH(readGeometry(scratch.path / "b.ply"), Contains("b.ply: not a file"));
  CHECK_THAT(refusalOf("a.obj", ""), Contains("the file is empty"));
}

TEST_CASE("readGeometry: a point that is not finite is named", "[caches]") {
  for (const float bad : {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()}) {
    std::string bytes = bobj(false), number;
    put(number, bad);
    bytes.replace(4 + 4 * 7, 4, number);
    CHECK_THAT(refusalOf("a.bobj", bytes), Contains("point 3 of 5 is not at finite numbers"));
  }
  // Too far for single precision.
  CHECK_THAT(refusalOf("a.obj", "v 0 0 0\nv 0 1e39 0\nv 1 1 1\nf 1 2 3\n"), Contains("point 2 of 3"));
}

TEST_CASE("gzip: what was packed, in several members, with zeros behind", "[caches]") {
  std::string bytes;
  for (int n = 0; n < 100000; ++n) put(bytes, std::int32_t(n * n));
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
