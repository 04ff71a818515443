#include "sim/grid/write_grids.h"

#include "tests/file_limit.h"
#include "tests/scratch.h"

#include <openvdb/io/File.h>
#include <catch2/catch.hpp>

#include <cstring>
#include <limits>

using namespace fluidtex::sim;

TEST_CASE("grids: a file holds every bit, of inactive voxels and tiles too") {
  const Scratch scratch;
  auto grid = openvdb::FloatGrid::create(3.0f);
  grid->setName("phi");
  grid->tree().addTile(1, openvdb::Coord(64), -2.5f, false);
  auto* leaf = grid->tree().touchLeaf(openvdb::Coord(0));
  const float values[] = {-0.0f, 1e-42f, std::numeric_limits<float>::quiet_NaN(), 0.1f};
  for (int n = 0; n < 4; ++n) {
    leaf->setValueOnly(n, values[n]);
    leaf->setActiveState(n, n % 2 == 0);
  }
  openvdb::MetaMap metadata;
  metadata.insertMeta("frame", openvdb::Int32Metadata(7));
  const auto file = scratch.path / "grids.vdb";
  writeGrids({grid}, metadata, file);

  openvdb::io::File in(file.string());
  in.open();
  CHECK(in.getMetadata()->metaValue<std::int32_t>("frame") == 7);
  const auto read = openvdb::gridPtrCast<openvdb::FloatGrid>(in.readGrid("phi"));
  CHECK(read->tree().hasSameTopology(grid->tree()));
  CHECK(read->tree().getValue(openvdb::Coord(66)) == -2.5f);
  const float* back = read->tree().probeConstLeaf(openvdb::Coord(0))->buffer().data();
  CHECK(std::memcmp(back, values, sizeof values) == 0);
}

TEST_CASE("grids: a folder that is not there and a disk that is full are told") {
  const Scratch scratch;
  auto grid = openvdb::FloatGrid::create(0.0f);
  for (int n = 0; n < 200; ++n) grid->tree().setValueOn(openvdb::Coord(8 * n, 0, 0), float(n));
  CHECK_THROWS_WITH(writeGrids({grid}, {}, scratch.path / "none" / "grids.vdb"),
                    Catch::Contains("grids.vdb: cannot be written: No such file"));
  const FileLimit limit(10000);
  CHECK_THROWS_WITH(writeGrids({grid}, {}, scratch.path / "grids.vdb"), Catch::Contains("File too large"));
}
