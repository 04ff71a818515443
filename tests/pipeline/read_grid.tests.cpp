#include "pipeline/read_grid.h"

#include "tests/scratch.h"

#include <catch2/catch.hpp>

using namespace fluidtex;

TEST_CASE("read_grid: the first grid of a type, and a clear word about a file without one", "[pipeline]") {
  openvdb::initialize();
  const Scratch scratch;
  const auto file = scratch.path / "field.vdb";
  const openvdb::Vec3f value(0.0f, 3.0f, 0.0f);
  openvdb::io::File(file.string()).write({openvdb::FloatGrid::create(), openvdb::Vec3SGrid::create(value)});
  CHECK(pipeline::readGrid<openvdb::Vec3SGrid>(file)->background() == value);
  openvdb::io::File(file.string()).write({openvdb::FloatGrid::create()});
  CHECK_THROWS_WITH(pipeline::readGrid<openvdb::Vec3SGrid>(file),
                    Catch::Contains("field.vdb: holds no grid of float vectors"));
  CHECK_THROWS_WITH(pipeline::readGrid<openvdb::Vec3SGrid>(scratch.path / "missing.vdb"),
                    Catch::Contains("missing.vdb: "));
}
