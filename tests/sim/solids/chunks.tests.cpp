#include "sim/solids/chunks.h"

#include "sim/grid/mac_grid.h"

#include <catch2/catch.hpp>

using namespace fluidtex::sim;

TEST_CASE("chunks: a box touches those of its corners, also below 0", "[sim]") {
  CHECK(chunksIn(CoordBBox(Coord(0), Coord(31))) == Chunks{Coord(0)});
  CHECK(chunksIn(CoordBBox(Coord(-1, 0, 0), Coord(0))) == Chunks{Coord(-32, 0, 0), Coord(0)});
  CHECK(chunksIn(CoordBBox(Coord(0), Coord(63))).size() == 8);
}

TEST_CASE("chunks: around liquid, in order, each once, and none beyond the box", "[sim]") {
  FloatGrid::Ptr phi = makePhi(0.1, 0.3);
  phi->tree().setValueOn(Coord(40, 40, 40), -0.1f);
  phi->tree().setValueOn(Coord(45, 40, 40), -0.1f);  // the same chunk
  const CoordBBox box(Coord(0), Coord(95));
  CHECK(chunksAround({phi.get()}, 0, box) == Chunks{Coord(32)});
  const Chunks around = chunksAround({phi.get()}, 1, box);
  CHECK(around.size() == 27);
  CHECK(std::is_sorted(around.begin(), around.end()));
  CHECK(chunksAround({phi.get()}, 1, CoordBBox(Coord(0), Coord(63))).size() == 8);
  CHECK(chunksAround({phi.get(), phi.get()}, 1, box) == around);
}

TEST_CASE("chunks: united lists have each once, and cover their parts", "[sim]") {
  const Chunks a{Coord(0), Coord(32)}, b{Coord(-32), Coord(32)};
  const Chunks both = united(a, b);
  CHECK(both.size() == 3);
  CHECK(covers(both, a));
  CHECK(covers(both, b));
  CHECK_FALSE(covers(a, b));
}
