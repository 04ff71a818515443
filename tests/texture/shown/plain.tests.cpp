#include "texture/shown/plain.h"

#include "tests/texture/shown/oriented_sphere.h"

#include <catch2/catch.hpp>

#include <stdexcept>

using namespace fluidtex;
using namespace fluidtex::testing;
using namespace fluidtex::texture;

namespace {

Carried carriedBy(std::size_t count) {
  Carried carried;
  carried.orientation.assign(count, Vec3f(1, 0, 0));
  carried.color.assign(count, Vec4f(0.1f, 0.2f, 0.3f, 1.0f));
  carried.coordinate.assign(count, Vec2f(3, 4));
  carried.gradient.resize(count);
  carried.age.assign(count, 0.5f);
  carried.trust.assign(count, 0.25f);
  carried.previousPosition.assign(count, Vec3f(7, 8, 9));
  return carried;
}

}  // namespace

TEST_CASE("plain frames: what was carried stays, older by a frame", "[texture]") {
  const Surface surface = orientedSphere();
  const std::size_t count = surface.levels[0].positions.size();
  const TexturedSurface result = advected(surface, carriedBy(count), 0.25);
  REQUIRE(result.positions == surface.levels[0].positions);
  REQUIRE(result.orientation == surface.levels[0].orientation);
  for (std::size_t v = 0; v < count; ++v) {
    REQUIRE(result.color[v] == Vec4f(0.1f, 0.2f, 0.3f, 1.0f));
    REQUIRE(result.coordinate[v] == Vec2f(3, 4));
    REQUIRE(result.age[v] == 0.75f);
    REQUIRE(result.trust[v] == 0.25f);
    REQUIRE(result.previousPosition[v] == Vec3f(7, 8, 9));
  }
  CHECK_THROWS_AS(advected(surface, carriedBy(count - 1), 0.25), std::invalid_argument);
}

TEST_CASE("plain frames: untextured is one colour all over", "[texture]") {
  const Surface surface = orientedSphere();
  const std::size_t count = surface.levels[0].positions.size();
  const TexturedSurface first = untextured(surface, {}), later = untextured(surface, carriedBy(count));
  REQUIRE(first.color == std::vector<Vec4f>(count, first.color[0]));
  CHECK(later.color == first.color);
  CHECK(first.previousPosition == first.positions);
  CHECK(first.trust == std::vector<float>(count, 0.0f));
  CHECK(later.previousPosition[0] == Vec3f(7, 8, 9));
  CHECK(untextured({}, {}).empty());
  Surface bare = surface;
  bare.levels[0].orientation.clear();
  CHECK_THROWS_AS(untextured(bare, {}), std::invalid_argument);
}
