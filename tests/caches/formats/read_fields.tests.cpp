#include "caches/formats/read_fields.h"

#include "caches/formats/format_error.h"
#include "tests/scratch.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex::caches;
using Catch::Matchers::Contains;
using openvdb::Coord;
using openvdb::Vec3d;
using openvdb::Vec3s;

namespace {

struct Files {
  Scratch scratch;
  std::filesystem::path file = scratch.path / "a.vdb";

  Files() { openvdb::initialize(); }
  void write(const openvdb::GridCPtrVec& grids) const { openvdb::io::File(file.string()).write(grids); }
};

}  // namespace

TEST_CASE("read_fields: a field of vectors in 16 bits, as large as those of simulations", "[caches]") {
  const Files files;
  const auto grid = openvdb::Vec3SGrid::create(Vec3s(0.0f, 0.0f, -1.0f));
  grid->setName("velocity");
  grid->setGridClass(openvdb::GRID_STAGGERED);
  const auto transform = openvdb::math::Transform::createLinearTransform(0.125);
  transform->postRotate(0.5, openvdb::math::Z_AXIS);
  grid->setTransform(transform);
  grid->denseFill(openvdb::CoordBBox(Coord(-30), Coord(33)), Vec3s(0.0f), true);
  for (auto leaf = grid->tree().beginLeaf(); leaf; ++leaf)
    for (auto value = leaf->beginValueOn(); value; ++value)
      value.setValue(value.getCoord().asVec3s() * 0.25f);  // which 16 bits hold
  grid->setSaveFloatAsHalf(true);
  files.write({grid});
  const auto got = readVectors(files.file, "velocity");
  CHECK(got->getName() == "velocity");
  CHECK(got->getGridClass() == openvdb::GRID_STAGGERED);
  CHECK(got->background() == Vec3s(0.0f, 0.0f, -1.0f));
  CHECK(got->transform() == *transform);
  CHECK(got->tree().hasSameTopology(grid->tree()));
  CHECK_FALSE(got->saveFloatAsHalf());
  std::size_t wrong = 0;
  for (auto value = got->cbeginValueOn(); value; ++value)
    wrong += *value != value.getCoord().asVec3s() * 0.25f;
  CHECK(wrong == 0);
}

TEST_CASE("read_fields: in a program that has not made OpenVDB ready", "[caches]") {
  const Files files;
  const auto grid = openvdb::FloatGrid::create(2.0f);
  grid->setName("phi");
  files.write({grid});
  openvdb::uninitialize();
  CHECK(readScalars(files.file, "phi")->background() == 2.0f);
}

TEST_CASE("read_fields: velocities in three grids, of doubles", "[caches]") {
  const Files files;
  openvdb::GridCPtrVec grids;
  for (const char* name : {"vel.x", "vel.y", "vel.z"}) {
    const auto grid = openvdb::DoubleGrid::create(0.5);
    grid->setName(name);
    grid->tree().setValue(Coord(1, 2, 3), double(name[4]));
    grids.push_back(grid);
  }
  files.write(grids);
  CHECK(readScalars(files.file, "vel.y")->tree().getValue(Coord(1, 2, 3)) == float('y'));
  CHECK(readScalars(files.file, "vel.z")->tree().getValue(Coord(1, 2, 3)) == float('z'));
  CHECK(readScalars(files.file, "vel.z")->background() == 0.5f);
}

TEST_CASE("read_fields: one sentence with the file's name about what cannot be read", "[caches]") {
  const Files files;
  const auto density = openvdb::FloatGrid::create(), broken = openvdb::FloatGrid::create();
  density->setName("density");
  broken->setName("broken");
  broken->tree().setValue(Coord(1, 2, 3), std::nanf(""));
  files.write({density, broken});
  CHECK_THROWS_AS(readScalars(files.file, "surface"), FormatError);
  CHECK_THROWS_WITH(readScalars(files.file, "surface"),
                    Contains("a.vdb: holds no grid \"surface\", but these: \"density\", \"broken\""));
  CHECK_THROWS_WITH(readVectors(files.file, "density"),
                    Contains("a.vdb: cannot be used: its grid \"density\" holds single numbers"));
  CHECK_THROWS_WITH(readScalars(files.file, "broken"), Contains("the first at (1, 2, 3)"));
  CHECK_THROWS_WITH(readVectors(files.scratch.path / "none.vdb", "v"), Contains("none.vdb: is no OpenVDB"));
  const std::string whole = readBytes(files.file);
  std::ofstream(files.file, std::ios::binary) << whole.substr(0, whole.size() - 20);
  CHECK_THROWS_AS(readScalars(files.file, "broken"), FormatError);
  CHECK(readScalars(files.file, "density")->activeVoxelCount() == 0);
}
