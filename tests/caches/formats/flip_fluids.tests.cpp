#include "caches/formats/flip_fluids.h"

#include "tests/caches/formats/pyramid_files.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex::caches;
using Catch::Matchers::Contains;

namespace {

const std::string kBounds =
    R"({"x": -1.5, "y": 2, "z": 3.25, "width": 4, "height": 5, "depth": 6, "dx": 0.125, "isize": 32, "jsize": 40, "ksize": 48, "more": [1]})";

}  // namespace

TEST_CASE("flip_fluids: vectors, with and without a number of triangles behind them", "[caches]") {
  for (const std::string& bytes : {bobj(false, false), bobj(false, false) + std::string(4, '\0')}) {
    const Written file("velocity000123.bobj", bytes);
    const std::vector<openvdb::Vec3f> vectors = readFlipVectors(file.path);
    REQUIRE(vectors.size() == 5);
    CHECK(vectors[4] == openvdb::Vec3f(1.0f, 0.5f, 3.0f));
  }
  CHECK(readFlipVectors(Written("velocity000001.bobj", std::string(4, '\0')).path).empty());
  CHECK_THROWS_WITH(readFlipVectors(Written("velocity000001.bobj", bobj(false)).path),
                    Contains("holds a mesh"));
  std::string bad = bobj(false, false);
  bad.replace(4 + 12, 4, std::string("\0\0\xc0\x7f", 4));
  CHECK_THROWS_WITH(readFlipVectors(Written("velocity000001.bobj", bad).path),
                    Contains("vertex 2 is not finite"));
}

TEST_CASE("flip_fluids: a value for each vertex", "[caches]") {
  CHECK(readFlipFloats(Written("age000001.data", bytesOf<float>({0.5, -1, 1e10})).path) ==
        std::vector<float>{0.5f, -1.0f, 1e10f});
  CHECK(readFlipIntegers(Written("sourceid000001.data", bytesOf<std::int32_t>({7, -1, 0})).path) ==
        std::vector<std::int32_t>{7, -1, 0});
  CHECK(readFlipFloats(Written("age000001.data", "").path).empty());
  CHECK(readFlipIntegers(Written("sourceid000001.data", "").path).empty());
  CHECK_THROWS_WITH(readFlipFloats(Written("age000001.data", "12345").path),
                    Contains("has 5 bytes; each value takes 4"));
  CHECK_THROWS_WITH(readFlipFloats(Written("age000001.data", bytesOf<float>({0, INFINITY})).path),
                    Contains("vertex 2 is not finite"));
  CHECK_THROWS_WITH(readFlipFloats("nowhere.data"), Contains("nowhere.data: no such file"));
}

TEST_CASE("flip_fluids: bounds", "[caches]") {
  const FlipBounds bounds = readFlipBounds(Written("bounds000001.bbox", kBounds).path);
  CHECK(bounds.min == openvdb::Vec3d(-1.5, 2, 3.25));
  CHECK(bounds.size == openvdb::Vec3d(4, 5, 6));
  CHECK(bounds.dx == 0.125);
  CHECK(bounds.cells == openvdb::Coord(32, 40, 48));
}

TEST_CASE("flip_fluids: bounds that are none", "[caches]") {
  const auto refused = [](const std::string& before, const std::string& after, const std::string& words) {
    std::string bytes = kBounds;
    bytes.replace(bytes.find(before), before.size(), after);
    CHECK_THROWS_WITH(readFlipBounds(Written("bounds000001.bbox", bytes).path), Contains(words));
  };
  refused("\"dx\"", "\"dz\"", "has no number 'dx'");
  refused("0.125", "\"0.125\"", "has no number 'dx'");
  refused("0.125", "0", "'dx' is not above 0");
  refused("-1.5", "1e999", "bounds000001.bbox: ");
  refused("40", "-40", "'jsize' is no number of cells");
  refused("40", "4e9", "'jsize' is no number of cells");
  refused("{", "[{", "is no JSON");
  CHECK_THROWS_WITH(readFlipBounds(Written("bounds000001.bbox", kBounds.substr(0, 40)).path),
                    Contains("is no JSON"));
}
