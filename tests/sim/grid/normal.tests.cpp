#include "sim/grid/normal.h"

#include <catch2/catch.hpp>

using namespace fluidtex::sim;

TEST_CASE("normal: of a plane and of a ball, whatever the function's slope", "[sim]") {
  const Vec3d up = Vec3d(1.0, -2.0, 2.0) / 3.0;
  const auto plane = [&](const Vec3d& x) { return 5.0 * (x.dot(up) - 0.3); };
  CHECK((normalAt(plane, Vec3d(0.1, 0.7, -0.4), 0.01) - up).length() < 1e-12);
  const auto ball = [](const Vec3d& x) { return (x - Vec3d(0.5)).length() - 0.2; };
  const Vec3d x(0.7, 0.4, 0.9);
  CHECK((normalAt(ball, x, 1e-3) - (x - Vec3d(0.5)).unit()).length() < 1e-5);
}

TEST_CASE("normal: none where the gradient is zero", "[sim]") {
  const auto ball = [](const Vec3d& x) { return x.length(); };
  CHECK(normalAt(ball, Vec3d(0.0), 0.1) == Vec3d(0.0));
  CHECK(normalAt([](const Vec3d&) { return 3.0; }, Vec3d(1.0), 0.1) == Vec3d(0.0));
}

TEST_CASE("normal: at a cell, from its neighbours", "[sim]") {
  const auto distance = FloatGrid::create(0.0f);
  const Vec3d up = Vec3d(2.0, 1.0, -2.0) / 3.0;
  for (int n = 0; n < 27; ++n) {
    const Coord cell(n / 9, n / 3 % 3, n % 3);
    distance->tree().setValue(cell, static_cast<float>(0.5 * cell.asVec3d().dot(up)));
  }
  CHECK((normalAt(distance->constTree(), Coord(1, 1, 1)) - up).length() < 1e-6);
  CHECK(normalAt(distance->constTree(), Coord(40, 1, 1)) == Vec3d(0.0));
}
