#include "sim/markers/drop_markers.h"

#include <catch2/catch.hpp>

#include <vector>

using namespace fluidtex::sim;

TEST_CASE("drop markers: those that are gone and blocks without any, in order", "[sim]") {
  Markers markers{{Coord(0, 0, 0), {{1.0f, 1.0f, 1.0f, 0.1f}, {2.0f, 2.0f, 2.0f, -0.2f}}},
                  {Coord(8, 0, 0), {{0.0f, 0.0f, 0.0f, 0.3f}}},
                  {Coord(16, 0, 0), {{0.0f, 0.0f, 0.0f, -0.4f}, {1.0f, 0.0f, 0.0f, -0.1f}}}};
  dropMarkers(markers, [](const Marker& m, const Coord&) { return m.radius > 0.0f; });
  REQUIRE(markers.size() == 2);
  CHECK(markers[0].origin == Coord(0, 0, 0));
  REQUIRE(markers[0].markers.size() == 1);
  CHECK(markers[0].markers[0].radius == -0.2f);
  CHECK(markers[1].origin == Coord(16, 0, 0));
  CHECK(markers[1].markers.size() == 2);
}

TEST_CASE("drop markers: the cell is that whose centre is nearest", "[sim]") {
  Markers markers{{Coord(8, -8, 0), {{0.4f, 7.6f, 2.7f, 0.1f}}}};
  std::vector<Coord> asked;
  dropMarkers(markers, [&](const Marker&, const Coord& cell) {
    asked.push_back(cell);
    return false;
  });
  CHECK(asked == std::vector<Coord>{Coord(8, 0, 3)});
  CHECK(markers.size() == 1);
}
