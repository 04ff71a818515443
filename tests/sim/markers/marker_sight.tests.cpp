#include "sim/markers/marker_sight.h"

#include "sim/solids/solids.h"

#include <catch2/catch.hpp>

using namespace fluidtex::sim;

namespace {

// A wall less than a cell thick between the cells 7 and 8 along x, and none elsewhere.
SolidField thinWall() {
  Options options;
  options.resolution = 16;
  const double h = options.voxelSize();
  options.solids.resize(1);
  options.solids[0].shape = {Box{Vec3d(7.8 * h, -1.0, -1.0), Vec3d(8.2 * h, 2.0, 2.0)}};
  return *Solids(options).at(0.0);
}

Marker at(float x, float y, float z) {
  return {x, y, z, 0.1f};
}

}  // namespace

TEST_CASE("marker sight: a thin wall separates markers on its two sides, and no others", "[sim]") {
  const SolidField solid = thinWall();
  REQUIRE(solid.visibility);
  const Sight sight(solid.visibility.get(), Coord(0));
  REQUIRE(sight.any());
  // Places are from the first cell's centre: 6.7 lies in cell 7.
  CHECK(sight.parts(at(6.7f, 4.0f, 4.0f), at(8.0f, 4.0f, 4.0f)));
  CHECK_FALSE(sight.parts(at(6.0f, 4.0f, 4.0f), at(7.0f, 4.0f, 4.0f)));
  CHECK_FALSE(sight.parts(at(6.7f, 4.0f, 4.0f), at(6.8f, 4.0f, 4.0f)));   // in one cell
  CHECK_FALSE(sight.parts(at(6.7f, 4.0f, 4.0f), at(10.0f, 4.0f, 4.0f)));  // three cells: not known
  const VisibleCells* cells = sight.at(at(6.7f, 4.0f, 4.0f));
  REQUIRE(cells != nullptr);
  CHECK(cells->sees(VisibleCells::kMiddle));
  CHECK_FALSE(cells->sees(VisibleCells::kMiddle + VisibleCells::kStride[0]));
}

TEST_CASE("marker sight: without thin solids all is seen", "[sim]") {
  const Sight nothing(nullptr, Coord(0));
  CHECK_FALSE(nothing.any());
  CHECK(nothing.at(at(1.0f, 1.0f, 1.0f)) == nullptr);
  CHECK_FALSE(nothing.parts(at(1.0f, 1.0f, 1.0f), at(2.0f, 1.0f, 1.0f)));
  CHECK(nearestCell(2.49f) == 2);
  CHECK(nearestCell(2.5f) == 3);
  CHECK(nearestCell(-0.6f) == -1);
}
