#include "sim/solids/constrain.h"

#include "tests/sim/solids/solid_scenes.h"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <numbers>

using namespace fluidtex::sim;
using Catch::Matchers::WithinAbs;

TEST_CASE("constrain: closed faces keep the motion along the solid only", "[sim]") {
  const int n = 16;
  const double h = 1.0 / n, angle = 20.0 * std::numbers::pi / 180.0;
  const Vec3d normal(-std::sin(angle), 0.0, std::cos(angle));
  Solids solids(tankWith(n, {solidOf(Shape{HalfSpace{Vec3d(0.0, 0.0, 0.3), normal}})}));
  const auto field = solids.at(0.0);
  auto phi = makePhi(h, 3 * h);
  phi->tree().fill(openvdb::CoordBBox(Coord(-3), Coord(n + 2)), static_cast<float>(-h), true);
  MaskGrid::Ptr nobody = MaskGrid::create();
  const FaceMasks valid{{MaskGrid::create(), MaskGrid::create(), MaskGrid::create()}};
  const auto speedInto = [&](double sign, const MaskGrid& separating) {
    Velocity carried;
    auto& c = carried.component;
    const Vec3d velocity =
        Vec3d(1.0, 0.5, std::tan(angle)) + sign * normal;  // along the slope, and into or off it
    for (int a = 0; a < 3; ++a) {
      c[a] = FloatGrid::create(0.0f);
      c[a]->tree().fill(openvdb::CoordBBox(Coord(-2), Coord(n + 1)), static_cast<float>(velocity[a]), true);
      c[a]->tree().voxelizeActiveTiles();
    }
    constrainToSolids(carried, *phi, *field, valid, separating);
    // A face just below the slope in the middle of the tank, and one in the open.
    const Coord open(8, 8, 14);
    for (int a = 0; a < 3; ++a) REQUIRE_THAT(c[a]->tree().getValue(open), WithinAbs(velocity[a], 1e-6));
    const Coord closed(8, 8, 6);
    REQUIRE(field->open[2].tree().getValue(closed) == 0.0f);
    // All but closed is closed, no more than that.
    int hair = 0, gap = 0;
    for (int i = 3; i < n - 3; ++i) {
      for (int k = 4; k < n - 2; ++k) {
        const Coord face(i, 8, k);
        const float share = field->open[2].tree().getValue(face);
        if (share <= 0.0f || share >= 1.0f) continue;
        const bool same = std::abs(c[2]->tree().getValue(face) - velocity[2]) < 1e-6;
        (share < kLeastOpen ? hair : gap) += 1;
        CHECK(same == (share >= kLeastOpen || (sign > 0.0 && !separating.empty())));
      }
    }
    CHECK(hair > 0);
    CHECK(gap > 0);
    return Vec3d(c[0]->tree().getValue(closed), c[1]->tree().getValue(closed), c[2]->tree().getValue(closed));
  };
  CHECK_THAT(speedInto(-1.0, *nobody).z(), WithinAbs(std::tan(angle), 0.02));
  CHECK_THAT(speedInto(1.0, *nobody).z(), WithinAbs(std::tan(angle), 0.02));
  MaskGrid::Ptr everybody = MaskGrid::create();
  everybody->tree().fill(openvdb::CoordBBox(Coord(-3), Coord(n + 2)), true, true);
  CHECK_THAT(speedInto(-1.0, *everybody).z(), WithinAbs(std::tan(angle), 0.02));
  CHECK_THAT(speedInto(1.0, *everybody).z(), WithinAbs(std::tan(angle) + normal.z(), 1e-6));  // it may leave
}

TEST_CASE("constrain: nothing moves between the two sides of a thin wall") {
  // A wall of 1.8 cells with two centres in it, wherever it ends; the air above it moves off.
  const int n = 16;
  const double h = 1.0 / n, low = GENERATE(7.75, 7.9, 8.0, 8.2, 8.4);
  Solids solids(
      tankWith(n, {solidOf(Shape{Box{Vec3d(-1.0, -1.0, low * h), Vec3d(2.0, 2.0, (low + 1.8) * h)}})}));
  const auto field = solids.at(0.0);
  const auto phi = makePhi(h, 6 * h);
  Velocity carried;
  auto& c = carried.component;
  for (int a = 0; a < 3; ++a) {
    c[a] = FloatGrid::create(0.0f);
    c[a]->tree().fill(openvdb::CoordBBox(Coord(-2), Coord(n + 1)), a == 2 ? 1.0f : 0.5f, true);
    c[a]->tree().voxelizeActiveTiles();
  }
  const FaceMasks none{{MaskGrid::create(), MaskGrid::create(), MaskGrid::create()}};
  constrainToSolids(carried, *phi, *field, none, *MaskGrid::create());
  CHECK(c[2]->tree().getValue(Coord(8, 8, 9)) == 0.0f);
  CHECK(c[0]->tree().getValue(Coord(8, 8, 9)) == 0.5f);
}
