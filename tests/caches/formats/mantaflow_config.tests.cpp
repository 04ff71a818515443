#include "caches/formats/mantaflow_config.h"

#include "tests/caches/formats/written_bytes.h"

#include <catch2/catch.hpp>

using namespace fluidtex::caches;
using Catch::Matchers::Contains;
using openvdb::Coord;
using openvdb::Vec3d;
using openvdb::Vec3f;

namespace {

// A domain of 2 x 1 x 1 of 20 x 10 x 10 cells, stretched along x, turned about z by 90 degrees and moved.
std::string configBytes() {
  std::string bytes;
  put(bytes, std::int32_t(3));
  bytes += bytesOf<std::int32_t>({20, 10, 10});
  bytes += bytesOf<float>({0.05, 0.1, -1, -0.5, -0.5, 1, 0.5, 0.5, 7, 8, 9});
  bytes += bytesOf<std::int32_t>({1, 2, 3});
  bytes += bytesOf<float>({0.25, 0.5, 0.75});
  bytes += bytesOf<float>({0, 3, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 10, 20, 30, 1});
  bytes += bytesOf<std::int32_t>({20, 10, 11, 0, 1, 2, 20, 11, 12});
  bytes += bytesOf<float>({0.1, 0.2, 0.3, 1.5});
  return bytes + std::string("C01", 4);
}

void checkRefused(const std::string& bytes, const std::string& words) {
  CHECK_THROWS_WITH(readMantaflowConfig(Written("config_0001.uni", bytes).path), Contains(words));
}

}  // namespace

TEST_CASE("mantaflow_config: all fields, packed by gzip or not", "[caches]") {
  REQUIRE(configBytes().size() == 204);
  for (const std::string& bytes : {configBytes(), gzipped(configBytes())}) {
    const Written file("config_0001.uni", bytes);
    const MantaflowConfig config = readMantaflowConfig(file.path);
    CHECK(config.activeFields == 3);
    CHECK(config.resolution == Coord(20, 10, 10));
    CHECK(config.dx == 0.05f);
    CHECK(config.dt == 0.1f);
    CHECK(config.p0 == Vec3f(-1.0f, -0.5f, -0.5f));
    CHECK(config.p1 == Vec3f(1.0f, 0.5f, 0.5f));
    CHECK(config.dp0 == Vec3f(7, 8, 9));
    CHECK(config.shift == Coord(1, 2, 3));
    CHECK(config.shiftedBy == Vec3f(0.25f, 0.5f, 0.75f));
    CHECK(config.baseResolution == Coord(20, 10, 11));
    CHECK(config.firstCell == Coord(0, 1, 2));
    CHECK(config.behindLastCell == Coord(20, 11, 12));
    CHECK(config.color == Vec3f(0.1f, 0.2f, 0.3f));
    CHECK(config.time == 1.5f);
    CHECK(config.worldFromObject.transform(Vec3d(0, 0, 0)) == Vec3d(10, 20, 30));
    CHECK(config.worldFromObject.transform(Vec3d(1, 0, 0)) == Vec3d(10, 23, 30));
    CHECK(config.worldFromObject.transform(Vec3d(0, 1, 0)) == Vec3d(9, 20, 30));
  }
}

TEST_CASE("mantaflow_config: what is no such file", "[caches]") {
  checkRefused(configBytes().substr(0, 200), "it has 200");
  checkRefused(configBytes() + "x", "it has 205");
  checkRefused(configBytes().replace(200, 3, "M4T"), "end with 'C01'");
  const auto with = [](std::size_t at, auto number) {
    std::string bytes = configBytes(), own;
    put(own, number);
    return bytes.replace(at, own.size(), own);
  };
  checkRefused(with(4, std::int32_t(0)), "0 x 10 x 10 cells");
  checkRefused(with(8, std::int32_t(-5)), "20 x -5 x 10 cells");
  checkRefused(with(16, 0.0f), "no domain");
  checkRefused(with(16, std::nanf("")), "not finite");
  checkRefused(with(24, INFINITY), "not finite");
  checkRefused(with(84, INFINITY), "not finite");
}
