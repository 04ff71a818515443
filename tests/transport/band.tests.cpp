#include "transport/band.h"

#include "tests/transport/velocity_grids.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace fluidtex;
using namespace fluidtex::testing;
using namespace fluidtex::transport;

TEST_CASE("band: the cells whose velocity is known, and their neighbours", "[transport]") {
  const Cells cells{0.1, -3, 4};
  const Band band = bandOf(steadyFrame(cells, 1.0, 2, [](const Vec3d&) { return Vec3d(1.0); }));
  CHECK(band.h == Approx(0.1));
  REQUIRE(band.cells.size() == 8 * 8 * 8);
  for (std::size_t cell = 0; cell < band.cells.size(); ++cell) {
    for (std::size_t side = 0; side < 6; ++side) {
      openvdb::Coord beside = band.cells[cell];
      beside[int(side / 2)] += side % 2 ? 1 : -1;
      const std::int32_t found = band.neighbor[cell][side];
      const int place = beside[int(side / 2)];
      REQUIRE((found == Band::kNone) == (place < -3 || place > 4));
      if (found != Band::kNone) REQUIRE(band.cells[std::size_t(found)] == beside);
    }
    REQUIRE((band.center(cell) - band.cells[cell].asVec3d() * 0.1).length() < 1e-6);
  }
  CHECK(bandOf(sim::Frame{}).cells.empty());
}

TEST_CASE("band: the velocity's gradient is exact for a linear flow, inside", "[transport]") {
  const Mat3d a = matrix(0.5, 1.0, -0.25, 2.0, -1.5, 0.125, 0.75, -0.5, 1.0);
  const sim::Frame frame = steadyFrame({0.1, -6, 6}, 1.0, 1, linearFlow(a));
  const Band band = bandOf(frame);
  const std::vector<Vec3d> velocity = velocityAtCells(band, frame.substeps[0]);
  for (std::size_t cell = 0; cell < band.cells.size(); ++cell) {
    const openvdb::Coord& c = band.cells[cell];
    if (std::max({std::abs(c[0]), std::abs(c[1]), std::abs(c[2])}) > 4) continue;
    REQUIRE((velocity[cell] - a * band.center(cell)).length() < 1e-5);
    REQUIRE(largestDifference(velocityGradient(band, velocity, cell), a) < 1e-4);
  }
}

TEST_CASE("band: upwind differences look against the flow, and sub-cycles keep below one cell",
          "[transport]") {
  const sim::Frame frame =
      steadyFrame({0.1, -3, 4}, 1.0, 1, [](const Vec3d&) { return Vec3d(1.0, -2.0, 0.0); });
  const Band band = bandOf(frame);
  const std::vector<Vec3d> velocity = velocityAtCells(band, frame.substeps[0]);
  std::vector<Vec3d> field;
  for (std::size_t cell = 0; cell < band.cells.size(); ++cell) {
    const Vec3d x = band.center(cell);
    field.emplace_back(x.x() * x.x(), x.y(), 3.0);
  }
  for (std::size_t cell = 0; cell < band.cells.size(); ++cell) {
    const openvdb::Coord& c = band.cells[cell];
    const double x = band.center(cell).x();
    const Vec3d d = upwindDerivative(band, velocity, field, cell);
    // Backward along x, forward along y; 0 where there is no cell to look at.
    CHECK(d.x() == Approx(c.x() == -3 ? 0.0 : 2.0 * x - 0.1).margin(1e-6));
    CHECK(d.y() == Approx(c.y() == 4 ? 0.0 : -2.0).margin(1e-6));
    CHECK(d.z() == 0.0);
  }
  const int parts = subcycles(band, velocity, 0.5);
  CHECK(0.5 / parts * 3.0 / 0.1 < 1.0);
  CHECK(0.5 / parts * 3.0 / 0.1 > 0.8);  // and not many more than needed
}

TEST_CASE("band: corners have trilinear weights, those beyond the rim none", "[transport]") {
  const Band band = bandOf(steadyFrame({0.1, -3, 4}, 1.0, 1, [](const Vec3d&) { return Vec3d(1.0); }));
  const Vec3d x(0.123, -0.05, 0.287);
  const Corners corners = cornersAt(band, x);
  CHECK(corners.known == Approx(1.0));
  Vec3d place(0.0), slope(0.0);
  for (std::size_t n = 0; n < 8; ++n) {
    place += corners.weight[n] * band.center(std::size_t(corners.cell[n]));
    slope += corners.slope[n];
  }
  CHECK((place - x).length() < 1e-9);
  CHECK(slope.length() < 1e-9);
  CHECK(cornersAt(band, Vec3d(0.43, 0.0, 0.0)).known == Approx(0.7));
  CHECK(cornersAt(band, Vec3d(5.0)).known == 0.0);
}
