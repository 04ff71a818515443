#include "sim/grid/leaf_table.h"

#include "sim/surface/level_set.h"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace fluidtex::sim;

TEST_CASE("leaf_table: neighbours lead to the coordinates beside") {
  FloatTree tree(0.0f);
  for (const Coord& origin : {Coord(0, 0, 0), Coord(-8, 0, 0), Coord(0, 8, 0), Coord(0, 0, -8)})
    tree.touchLeaf(origin);
  const LeafTable table = makeLeafTable(tree);
  REQUIRE(table.size() == 4);
  int wrong = 0, outside = 0;
  for (std::int64_t voxel = 0; voxel < static_cast<std::int64_t>(table.voxels()); ++voxel) {
    for (int direction = 0; direction < 6; ++direction) {
      Coord there = table.coord(voxel);
      there[direction / 2] += direction % 2 == 1 ? 1 : -1;
      const std::int64_t n = table.neighbor(voxel, direction);
      if (n < 0) {
        ++outside;
        if (tree.probeConstLeaf(there) != nullptr) ++wrong;
      } else if (table.coord(n) != there) {
        ++wrong;
      }
    }
  }
  CHECK(wrong == 0);
  CHECK(outside == (4 * 6 - 6) * 64);  // three pairs of leaves touch
}

TEST_CASE("leaf_table: blocks of liquid are those with a leaf or a tile inside", "[sim]") {
  const double h = 1.0 / 64.0;
  const Coord cells(64, 40, 64);
  FloatGrid::Ptr phi = makePhi(h, 4.0 * h);
  unite(
      *phi, [](const Vec3d& x) { return (x - Vec3d(0.4, 0.3, 0.6)).length() - 0.35; },
      grown(firstCells(cells), 8));
  for (const int margin : {0, 8}) {
    std::vector<Coord> expected;
    for (int i = -8; i < cells[0] + margin; i += 8)
      for (int j = -8; j < cells[1] + margin; j += 8)
        for (int k = -8; k < cells[2] + margin; k += 8) {
          const Coord origin(i, j, k);
          if (margin == 0 && (i < 0 || j < 0 || k < 0)) continue;
          if (phi->tree().probeConstLeaf(origin) != nullptr || phi->tree().getValue(origin) < 0.0f)
            expected.push_back(origin);
        }
    CHECK(wetLeaves(*phi, grown(firstCells(cells), margin)) == expected);
    CHECK(expected.size() > 100);
  }
}

TEST_CASE("leaf_table: values where there is a leaf, a tile, nothing", "[sim]") {
  FloatTree topology(0.0f), values(7.0f);
  for (const Coord& origin : {Coord(0, 0, 0), Coord(8, 0, 0), Coord(64, 0, 0)}) topology.touchLeaf(origin);
  values.setValue(Coord(1, 2, 3), -4.0f);
  values.addTile(1, Coord(8, 0, 0), 2.0f, false);
  const LeafTable table = makeLeafTable(topology);
  const std::vector<float> sampled = sampleOn(table, values);
  REQUIRE(sampled.size() == 3 * kLeafSize);
  for (std::int64_t n = 0; n < std::int64_t(table.voxels()); ++n)
    REQUIRE(sampled[std::size_t(n)] == values.getValue(table.coord(n)));

  std::array<float, kLeafSize> scratch{};
  CHECK(leafValues(values, Coord(0), scratch.data()) == values.probeConstLeaf(Coord(0))->buffer().data());
  CHECK(leafValues(values, Coord(8, 0, 0), scratch.data()) == scratch.data());
  CHECK(std::all_of(scratch.begin(), scratch.end(), [](float v) { return v == 2.0f; }));
  leafValues(values, Coord(64, 0, 0), scratch.data());
  CHECK(std::all_of(scratch.begin(), scratch.end(), [](float v) { return v == 7.0f; }));
}

TEST_CASE("leaf_table: tiles of liquid count by the blocks of theirs that lie in the box", "[sim]") {
  const FloatGrid::Ptr phi = makePhi(0.1, 0.3);
  phi->tree().addTile(2, Coord(0, 0, 0), -0.3f, false);  // of 32 cells, liquid
  phi->tree().addTile(1, Coord(40, 0, 0), 0.3f, false);  // air
  phi->tree().touchLeaf(Coord(48, 0, 0));                // in the box
  phi->tree().touchLeaf(Coord(200, 0, 0));               // outside
  const std::vector<Coord> wet = wetLeaves(*phi, openvdb::CoordBBox(Coord(0), Coord(55, 7, 15)));
  std::vector<Coord> expected;
  for (int i = 0; i < 32; i += 8)
    for (int k = 0; k < 16; k += 8) expected.emplace_back(i, 0, k);
  expected.emplace_back(48, 0, 0);
  CHECK(wet == expected);

  // A tile of the root, of 256 cells.
  const FloatGrid::Ptr deep = makePhi(0.1, 0.3);
  deep->tree().addTile(3, Coord(0), -0.3f, false);
  CHECK(wetLeaves(*deep, openvdb::CoordBBox(Coord(0), Coord(15, 7, 7))) ==
        std::vector<Coord>{Coord(0), Coord(8, 0, 0)});
}
