#include "sim/solids/domain.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex::sim;

TEST_CASE("domain: its cells cover its size, the last ones cut where they do not fit", "[sim]") {
  Options options;
  options.size = {1.0, 0.5, 0.26};
  options.resolution = 20;
  CHECK(domainCells(options) == CoordBBox(Coord(0), Coord(19, 9, 5)));
  CHECK(domainBox(options).min() == Vec3d(0.0));
  CHECK(domainBox(options).max() == options.size);
}

TEST_CASE("domain: goes on where a side is unbounded", "[sim]") {
  Options options;
  options.resolution = 16;
  options.sides[0] = Side::unbounded;
  options.sides[5] = Side::unbounded;
  const CoordBBox cells = domainCells(options);
  CHECK(cells.min() == Coord(-kEndless, 0, 0));
  CHECK(cells.max() == Coord(15, 15, kEndless - 1));
  CHECK(isEndless(cells));
  const openvdb::BBoxd box = domainBox(options);
  CHECK(std::isinf(box.min()[0]));
  CHECK(box.min()[2] == 0.0);
  CHECK(std::isinf(box.max()[2]));
  CHECK(box.max()[0] == options.size[0]);
}
