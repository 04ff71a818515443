#include "caches/formats/vtk_cells.h"

#include "tests/caches/formats/checks.h"

using namespace fluidtex::caches;
using Catch::Matchers::Contains;
using openvdb::Vec3I;

namespace {

Geometry sixPoints() {
  Geometry geometry;
  for (const float x : {0.0f, 1.0f, 2.0f})
    for (const float y : {0.0f, 1.0f}) geometry.points.emplace_back(x, y, 0.0f);
  return geometry;
}

std::vector<Vec3I> trianglesOf(const std::vector<std::int64_t>& corners,
                               const std::vector<std::int64_t>& ends,
                               const std::vector<std::int64_t>& kinds) {
  Geometry geometry = sixPoints();
  addCellsOfKinds(corners, ends, kinds, geometry);
  return geometry.triangles;
}

}  // namespace

TEST_CASE("vtk cells: kinds of cells that are surfaces, and others", "[caches]") {
  const auto grid = [](int kind) {
    return "# vtk DataFile Version 3.0\n\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 float\n0 0 0 1 0 0 0 1 "
           "0 1 1 0\nCELLS 1 5\n4 0 1 " +
           std::string(kind == 9 || kind == 7 ? "3 2" : "2 3") + "\nCELL_TYPES 1\n" + std::to_string(kind) +
           "\n";
  };
  for (const int kind : {6, 7, 8, 9}) {
    const Geometry square = geometryIn("a.vtk", grid(kind));
    CAPTURE(kind);
    REQUIRE(square.triangles.size() == 2);
    openvdb::Vec3d area(0.0);
    for (const openvdb::Vec3I& t : square.triangles) {
      const openvdb::Vec3d a(square.points[t[0]]), b(square.points[t[1]]), c(square.points[t[2]]);
      area += (b - a).cross(c - a) * 0.5;
    }
    CHECK(area == openvdb::Vec3d(0, 0, 1));
  }
  for (const int kind : {0, 1, 2, 3, 4}) CHECK(geometryIn("a.vtk", grid(kind)).triangles.empty());
  for (const int kind : {10, 12, 22, -1})
    CHECK_THAT(refusalOf("a.vtk", grid(kind)), Contains("cell 1 is of type " + std::to_string(kind)));
}

TEST_CASE("vtk cells: each kind with its own corners, in their order", "[caches]") {
  // A triangle, a line, a strip, a vertex, an empty cell, a pixel, a polygon of two corners.
  CHECK(trianglesOf({0, 2, 1, 4, 5, 1, 2, 3, 4, 5, 0, 1, 2, 3, 0, 1}, {3, 5, 9, 10, 10, 14, 16},
                    {5, 3, 6, 1, 0, 8, 7}) ==
        std::vector<Vec3I>{Vec3I(0, 2, 1), Vec3I(1, 2, 3), Vec3I(3, 2, 4), Vec3I(0, 1, 3), Vec3I(0, 3, 2)});
  CHECK(trianglesOf({}, {}, {}).empty());
}

TEST_CASE("vtk cells: what is no cell is told by its number", "[caches]") {
  CHECK_THROWS_WITH(trianglesOf({0, 1, 2}, {3}, {5, 5}), Contains("has 1 cell and 2 types of them"));
  CHECK_THROWS_WITH(trianglesOf({0, 1, 2, 3, 4, 6}, {3, 6}, {5, 5}), Contains("polygon 2 has point 6"));
  CHECK_THROWS_WITH(trianglesOf({0, 1, 2, 3, 4, -1}, {3, 6}, {5, 6}), Contains("strip 2 has point -1"));
  CHECK_THROWS_WITH(trianglesOf({0, 1, 2}, {3, 2}, {5, 5}), Contains("cell 2 takes corners 3 to 2 of 3"));
  CHECK_THROWS_WITH(trianglesOf({0, 1, 2}, {3, 4}, {5, 1}), Contains("cell 2 takes corners 3 to 4 of 3"));
  CHECK_THROWS_WITH(trianglesOf({0, 1, 2, 3}, {3, 4}, {5, 10}), Contains("cell 2 is of type 10"));
}
