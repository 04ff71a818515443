#include "caches/formats/flip_fluids.h"

#include "tests/caches/formats/pyramid_files.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex::caches;
using Catch::Matchers::Contains;

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
