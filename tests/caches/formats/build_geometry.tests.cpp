#include "caches/formats/build_geometry.h"

#include <catch2/catch.hpp>

#include <array>
#include <limits>

using namespace fluidtex::caches;
using Catch::Matchers::Contains;
using openvdb::Vec3f;
using openvdb::Vec3I;

namespace {

// In the plane z = 0.
Geometry flat(const std::vector<std::array<float, 2>>& points) {
  Geometry geometry;
  for (const auto& [x, y] : points) geometry.points.emplace_back(x, y, 0.0f);
  return geometry;
}

using Corners = std::vector<std::int64_t>;

std::vector<Vec3I> strip(const Corners& corners) {
  Geometry geometry = flat({{0, 0}, {0, 1}, {1, 0}, {1, 1}, {2, 0}});
  addStrip(corners, 0, geometry);
  return geometry.triangles;
}

}  // namespace

TEST_CASE("build geometry: points come behind those there are", "[caches]") {
  Geometry geometry;
  addPoints(std::array{1.0f, 2.0f, 3.0f}, geometry);
  addPoints({}, geometry);
  addPoints(std::array{4.0f, 5.0f, 6.0f, 7.0f, 8.0f, 9.0f}, geometry);
  CHECK(geometry.points == std::vector<Vec3f>{Vec3f(1, 2, 3), Vec3f(4, 5, 6), Vec3f(7, 8, 9)});
}

TEST_CASE("build geometry: an attribute has one row for each point, and takes the place of its name",
          "[caches]") {
  Geometry geometry = flat({{0, 0}, {1, 0}});
  addAttribute("v", 3, {1, 2, 3, 4, 5, 6}, geometry);
  CHECK(geometry.attributes.at("v").components == 3);
  CHECK(geometry.attributes.at("v").values == std::vector<float>{1, 2, 3, 4, 5, 6});
  addAttribute("v", 1, {7, 8}, geometry);
  CHECK(geometry.attributes.size() == 1);
  CHECK(geometry.attributes.at("v").components == 1);
  CHECK(geometry.attributes.at("v").values == std::vector<float>{7, 8});

  CHECK_THROWS_WITH(addAttribute("w", 2, {1, 2, 3}, geometry),
                    Contains("'w' has 3 values in rows of 2 for 2 points"));
  CHECK_THROWS_WITH(addAttribute("w", 1, {1}, geometry), Contains("'w' has 1 value in rows of 1"));
  CHECK_THROWS(addAttribute("w", 1, {1, 2, 3}, geometry));
  CHECK_THROWS(addAttribute("w", 0, {}, geometry));
  // As many components as no int holds.
  Geometry none;
  CHECK_THROWS(addAttribute("w", std::numeric_limits<std::uint64_t>::max(), {}, none));
  CHECK_NOTHROW(addAttribute("w", 3, {}, none));
  CHECK_FALSE(geometry.attributes.contains("w"));
}

TEST_CASE("build geometry: a polygon becomes triangles that are turned as it is", "[caches]") {
  // An arrow's head: a cut from the second corner to the last would lie outside of it.
  Geometry geometry = flat({{0, 0}, {2, -2}, {1, 0}, {2, 2}});
  addPolygon(Corners{3, 1, 2}, 0, geometry);
  REQUIRE(geometry.triangles == std::vector<Vec3I>{Vec3I(3, 1, 2)});
  geometry.triangles.clear();
  for (const Corners& corners : {Corners{0, 1, 2, 3}, Corners{1, 2, 3, 0}, Corners{3, 2, 1, 0}}) {
    geometry.triangles.clear();
    addPolygon(corners, 0, geometry);
    REQUIRE(geometry.triangles.size() == 2);
    const double turned = corners[0] == 3 ? -1.0 : 1.0;
    for (const Vec3I& t : geometry.triangles) {
      const Vec3f a = geometry.points[t[0]], b = geometry.points[t[1]], c = geometry.points[t[2]];
      CHECK(0.5 * double((b - a).cross(c - a)[2]) == turned);
    }
  }
  geometry.triangles.clear();
  addPolygon(Corners{0, 1}, 0, geometry);
  addPolygon(Corners{}, 0, geometry);
  CHECK(geometry.triangles.empty());
}

TEST_CASE("build geometry: a strip turns every other triangle, those included that lead it on", "[caches]") {
  CHECK(strip({0, 1, 2, 3, 4}) == std::vector<Vec3I>{Vec3I(0, 1, 2), Vec3I(2, 1, 3), Vec3I(2, 3, 4)});
  CHECK(strip({0, 1, 2, 2, 3, 4}) == std::vector<Vec3I>{Vec3I(0, 1, 2), Vec3I(3, 2, 4)});
  CHECK(strip({0, 1, 0, 2}) == std::vector<Vec3I>{Vec3I(0, 1, 2)});
  CHECK(strip({0, 1}).empty());
  CHECK(strip({}).empty());
}

TEST_CASE("build geometry: a corner that is no point is told, and nothing is added", "[caches]") {
  Geometry geometry = flat({{0, 0}, {1, 0}, {0, 1}});
  CHECK_THROWS_WITH(addPolygon(Corners{0, 1, 3}, 4, geometry),
                    Contains("polygon 5 has point 3, counted from 0") && Contains("there are 3 points"));
  CHECK_THROWS_WITH(addPolygon(Corners{0, -1}, 0, geometry), Contains("polygon 1 has point -1"));
  CHECK_THROWS_WITH(addStrip(Corners{0, 1, 2, 9}, 1, geometry), Contains("strip 2 has point 9"));
  CHECK(geometry.triangles.empty());
}

TEST_CASE("build geometry: the corners of a cell lie among those of all", "[caches]") {
  const Corners all{5, 6, 7, 8};
  const auto some = cornersOf(all, 1, 3, 0);
  CHECK(Corners(some.begin(), some.end()) == Corners{6, 7});
  CHECK(cornersOf(all, 0, 4, 0).size() == 4);
  CHECK(cornersOf(all, 4, 4, 0).empty());
  CHECK_THROWS_WITH(cornersOf(all, 3, 2, 7), Contains("cell 8 takes corners 3 to 2 of 4"));
  CHECK_THROWS(cornersOf(all, 3, 5, 0));
  CHECK_THROWS(cornersOf(all, -1, 2, 0));
}

TEST_CASE("build geometry: cells lie one behind the other", "[caches]") {
  Geometry geometry = flat({{0, 0}, {1, 0}, {0, 1}, {1, 1}});
  addCells(Corners{0, 1, 2, 3, 1, 2, 1, 3}, Corners{3, 4, 8}, addStrip, geometry);
  CHECK(geometry.triangles == std::vector<Vec3I>{Vec3I(0, 1, 2), Vec3I(1, 2, 3)});
  CHECK_THROWS_WITH(addCells(Corners{0, 1, 2}, Corners{3, 1}, addPolygon, geometry),
                    Contains("cell 2 takes corners 3 to 1"));
}

TEST_CASE("build geometry: one thing, and several", "[caches]") {
  CHECK(counted(0, "point") == "0 points");
  CHECK(counted(1, "point") == "1 point");
  CHECK(counted(12, "point") == "12 points");
}
