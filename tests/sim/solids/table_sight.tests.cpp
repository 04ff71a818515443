#include "sim/solids/table_sight.h"

#include "sim/solids/solids.h"
#include "tests/sim/step/solver_scenes.h"

#include <catch2/catch.hpp>

using namespace fluidtex::sim;

namespace {

// A plate across x from 15.7 to 16.3 of 32 cells, up to cell 20: no cell's centre is in it, and it shuts the
// faces between cells 15 and 16.
struct Plate {
  std::shared_ptr<const SolidField> solid;
  LeafTable table;

  Plate() {
    Options options = tank(32, {});
    options.solids.resize(1);
    options.solids[0].shape = {Box{Vec3d(15.7 / 32, -1.0, -1.0), Vec3d(16.3 / 32, 2.0, 20.0 / 32)}};
    solid = Solids(options).at(0.0);
    FloatTree tree;
    for (int n = 0; n < 64; ++n) tree.touchLeaf(Coord(8 * (n / 16), 8 * (n / 4 % 4), 8 * (n % 4)));
    table = makeLeafTable(tree);
  }
  std::int64_t at(int i, int j, int k) const {
    for (std::int64_t v = 0; v < static_cast<std::int64_t>(table.voxels()); ++v)
      if (table.coord(v) == Coord(i, j, k)) return v;
    return -1;
  }
};

}  // namespace

TEST_CASE("table sight: a thin wall hides cells and faces of its other side, and not those above it") {
  const Plate plate;
  const TableSight sight(plate.table, plate.solid->visibility.get());
  const auto v = [&](int i, int k) { return plate.at(i, 10, k); };
  for (const int side : {0, 1}) {  // from both sides, towards the wall
    const int here = side == 0 ? 15 : 16, there = 31 - here, towards = side == 0 ? 1 : 0;
    CHECK(sight.cell(v(here, 10), towards) == -1);
    CHECK(sight.cell(v(here, 10), 1 - towards) == v(here + (side == 0 ? -1 : 1), 10));
    CHECK(sight.cell(v(here, 25), towards) == v(there, 25));
    for (const int axis : {1, 2}) {  // faces that end at the wall
      CHECK(sight.hidesFace(v(here, 10), axis, towards));
      CHECK(sight.face(v(here, 10), axis, towards) == -1);
      CHECK(sight.face(v(here, 10), axis, 5) == v(here, 11));
      CHECK(sight.face(v(here, 25), axis, towards) == v(there, 25));
    }
  }
  // Faces in line share a cell; the one in the wall belongs to neither side.
  CHECK(sight.inWall(v(16, 10), 0));
  CHECK_FALSE(sight.inWall(v(15, 10), 0));
  CHECK_FALSE(sight.inWall(v(16, 25), 0));
  CHECK(sight.face(v(15, 10), 0, 1) == -1);
  CHECK(sight.face(v(16, 10), 0, 1) == v(17, 10));
  CHECK(sight.face(v(14, 10), 0, 1) == v(15, 10));
}

TEST_CASE("table sight: without thin walls it is the table's neighbour") {
  const Plate plate;
  const TableSight sight(plate.table, nullptr);
  for (int direction = 0; direction < 6; ++direction) {
    const std::int64_t cell = plate.at(15, 10, 10), next = plate.table.neighbor(cell, direction);
    CHECK(sight.cell(cell, direction) == next);
    CHECK(sight.face(cell, 0, direction) == next);
  }
  CHECK_FALSE(sight.inWall(plate.at(16, 10, 10), 0));
}
