#include "sim/meshes/cut_polygon.h"

#include "tests/sim/meshes/mesh_files.h"

#include <catch2/catch.hpp>

#include <string>

using namespace fluidtex::sim;

namespace {

// Twice the area vector of the triangles together.
Vec3d areaOf(const std::vector<Vec3d>& points, const std::vector<std::array<std::size_t, 3>>& triangles) {
  Vec3d sum(0.0);
  for (const auto& [a, b, c] : triangles) sum += (points[b] - points[a]).cross(points[c] - points[a]);
  return sum;
}

double unsignedAreaOf(const std::vector<Vec3d>& points,
                      const std::vector<std::array<std::size_t, 3>>& triangles) {
  double sum = 0.0;
  for (const auto& [a, b, c] : triangles)
    sum += (points[b] - points[a]).cross(points[c] - points[a]).length();
  return sum;
}

}  // namespace

TEST_CASE("cut polygon: concave polygons and such that touch themselves are cut", "[sim]") {
  CHECK(volumeOf(meshOf("l.obj", prismObj())) == Approx(3.0));

  // A square with a hole, whose rim is joined to the outer one by a slit.
  std::string ring;
  for (const double z : {0.0, 1.0}) {
    for (const auto& [x, y] : {std::pair{0, 0}, {3, 0}, {3, 3}, {0, 3}}) ring += vertex(x, y, z);
    for (const auto& [x, y] : {std::pair{1, 1}, {2, 1}, {2, 2}, {1, 2}}) ring += vertex(x, y, z);
  }
  ring += "f 1 5 8 7 6 5 1 4 3 2\nf 9 10 11 12 9 13 16 15 14 13\n";
  for (int n = 1; n <= 4; ++n) {
    const int next = n % 4 + 1;
    ring += "f " + std::to_string(n) + " " + std::to_string(next) + " " + std::to_string(next + 8) + " " +
            std::to_string(n + 8) + "\n";
    ring += "f " + std::to_string(n + 12) + " " + std::to_string(next + 12) + " " + std::to_string(next + 4) +
            " " + std::to_string(n + 4) + "\n";
  }
  CHECK(volumeOf(meshOf("ring.obj", ring)) == Approx(8.0));
}

TEST_CASE("cut polygon: a concave one is covered once, in either direction", "[sim]") {
  // An arrow head in a slanted plane; 7 is no corner.
  const std::vector<Vec3d> points{{0, 0, 0}, {4, 0, 4}, {2, 1, 2}, {2, 5, 2}, {9, 9, 9}};
  for (const std::vector<std::size_t>& corners : {std::vector<std::size_t>{0, 2, 1, 3}, {3, 1, 2, 0}}) {
    const auto triangles = cutPolygon(points, corners);
    REQUIRE(triangles.size() == 2);
    Vec3d polygon(0.0);
    for (std::size_t n = 0; n < corners.size(); ++n)
      polygon += points[corners[n]].cross(points[corners[(n + 1) % corners.size()]]);
    CHECK((areaOf(points, triangles) - polygon).length() < 1e-12);
    CHECK(unsignedAreaOf(points, triangles) == Approx(polygon.length()));
  }
}
