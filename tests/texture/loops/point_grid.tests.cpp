#include "texture/loops/point_grid.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <random>

using namespace fluidtex::texture;

TEST_CASE("point grid: what lies too far away for the number of its cell is found, too") {
  const std::vector<Vec3f> points{{0, 0, 0}, {1e30f, 0, 0}, {0, -4e9f, 0}};
  const PointGrid grid(points, 0.5);
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    std::vector<std::uint32_t> found;
    grid.visitNear(points[i], [&](std::uint32_t index) { found.push_back(index); });
    CHECK(found == std::vector{i});
  }
}

TEST_CASE("point grid: all points within a cell's width are visited, and none twice") {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> place(-2.0f, 2.0f);
  std::vector<Vec3f> points;
  for (int n = 0; n < 500; ++n) points.emplace_back(place(random), place(random), place(random));
  const PointGrid grid(points, 0.5);
  for (int n = 0; n < 100; ++n) {
    const Vec3f x(place(random), place(random), place(random));
    std::vector<std::uint32_t> found;
    grid.visitNear(x, [&](std::uint32_t index) { found.push_back(index); });
    std::sort(found.begin(), found.end());
    REQUIRE(std::adjacent_find(found.begin(), found.end()) == found.end());
    for (std::uint32_t i = 0; i < points.size(); ++i)
      if ((points[i] - x).length() < 0.5f) REQUIRE(std::binary_search(found.begin(), found.end(), i));
  }
}

TEST_CASE("point grid: cells are half open, and clamped where numbers end") {
  CHECK(cellAlong(-0.001) == -1);
  CHECK(cellAlong(0.0) == 0);
  CHECK(cellAlong(1e30) == 1000000000);
  CHECK(cellAlong(-1e30) == -1000000000);
  CHECK(cellAt(Vec3f(0.6f, -0.1f, 1.0f), 2.0) == Cell{1, -1, 2});
  // The 64 cells of a cube lie side by side.
  const std::size_t base = nearbySlot(4, 8, 12, ~std::size_t(0));
  CHECK(nearbySlot(5, 8, 12, ~std::size_t(0)) == base + 16);
  CHECK(nearbySlot(4, 9, 12, ~std::size_t(0)) == base + 4);
  CHECK(nearbySlot(4, 8, 13, ~std::size_t(0)) == base + 1);
}
