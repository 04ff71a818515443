#include "foreign/grid.h"

#include "tests/scratch.h"

#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <cstring>
#include <ios>
#include <limits>
#include <random>
#include <sstream>

using namespace fluidtex::foreign;
using Catch::Matchers::Contains;
using openvdb::Coord;
using openvdb::DoubleGrid;
using openvdb::FloatGrid;
using openvdb::Vec3d;
using openvdb::Vec3s;
using openvdb::Vec3SGrid;

namespace {

constexpr float kInfinite = std::numeric_limits<float>::infinity();

struct Files {
  Scratch scratch;
  std::filesystem::path file = scratch.path / "a.vdb";

  Files() { openvdb::initialize(); }
  void write(const openvdb::GridCPtrVec& grids) const { openvdb::io::File(file.string()).write(grids); }
  void writeBytes(const std::string& bytes) const { std::ofstream(file, std::ios::binary) << bytes; }
};

template <class Grid>
typename Grid::Ptr made(const std::string& name, const typename Grid::ValueType& value) {
  const auto grid = Grid::create();
  grid->setName(name);
  for (int i = 0; i < 20; ++i) grid->tree().setValue(Coord(i, -2 * i, 3), value);
  return grid;
}

template <class Grid>
typename Grid::Ptr parsed(const std::string& stream) {
  std::istringstream in(stream);
  openvdb::io::Stream grids(in, false);
  REQUIRE(grids.getGrids()->size() == 1);
  REQUIRE(grids.getGrids()->at(0)->isType<Grid>());
  return openvdb::gridPtrCast<Grid>(grids.getGrids()->at(0));
}

FloatGrid::Ptr scalars(const std::filesystem::path& file, const std::string& name) {
  return parsed<FloatGrid>(readGrid(file, name, false));
}

Vec3SGrid::Ptr vectors(const std::filesystem::path& file, const std::string& name) {
  return parsed<Vec3SGrid>(readGrid(file, name, true));
}

// In all places of the bytes, by words of the same length.
std::string renamed(std::string bytes, const std::string& from, const std::string& to) {
  REQUIRE(from.size() == to.size());
  for (std::size_t at = bytes.find(from); at != bytes.npos; at = bytes.find(from, at))
    bytes.replace(at, from.size(), to);
  return bytes;
}

}  // namespace

TEST_CASE("grid: names, types, classes and counts of all that are in the file", "[foreign]") {
  const Files files;
  const auto phi = made<FloatGrid>("vel.x", 1.0f), small = made<FloatGrid>("", 1.0f);
  phi->setGridClass(openvdb::GRID_LEVEL_SET);
  small->setGridClass(openvdb::GRID_FOG_VOLUME);
  small->setSaveFloatAsHalf(true);
  const auto velocity = made<Vec3SGrid>("v", Vec3s(1.0f));
  velocity->setGridClass(openvdb::GRID_STAGGERED);
  files.write({phi, small, velocity, made<DoubleGrid>("d", 1.0), made<openvdb::Int64Grid>("v", 1),
               made<openvdb::Vec3IGrid>("i", openvdb::Vec3i(1)), made<openvdb::MaskGrid>("s", true)});
  const std::vector<GridHead> heads = listGrids(files.file);
  REQUIRE(heads.size() == 7);
  const auto is = [&](std::size_t i, const char* name, const char* type, const char* kind) {
    CHECK(heads[i].name == name);
    CHECK(heads[i].type == type);
    CHECK(heads[i].gridClass == kind);
    CHECK(heads[i].activeVoxels == 20);
    CHECK(heads[i].half == (i == 1));
    CHECK(heads[i].readable == (i < 6));
    CHECK(heads[i].vectors == (i == 2 || i == 5));
  };
  is(0, "vel.x", "Tree_float_5_4_3", "level set");
  is(1, "", "Tree_float_5_4_3_HalfFloat", "fog volume");
  is(2, "v", "Tree_vec3s_5_4_3", "staggered");
  is(3, "d", "Tree_double_5_4_3", "unknown");
  is(4, "v", "Tree_int64_5_4_3", "unknown");
  is(5, "i", "Tree_vec3i_5_4_3", "unknown");
  is(6, "s", "Tree_mask_5_4_3", "unknown");
  CHECK(scalars(files.file, "")->getName().empty());
}

TEST_CASE("grid: numbers of all kinds become floats, and the rest stays what it was", "[foreign]") {
  const Files files;
  const auto density = made<DoubleGrid>("double", 0.1);
  density->tree().root().setBackground(2.5, true);
  density->fill(openvdb::CoordBBox(Coord(64), Coord(127)), 7.0);
  density->fill(openvdb::CoordBBox(Coord(256), Coord(263)), -1.0, false);
  density->setGridClass(openvdb::GRID_FOG_VOLUME);
  density->setTransform(openvdb::math::Transform::createLinearTransform(0.25));
  const auto small = made<DoubleGrid>("half", 0.1);
  small->setSaveFloatAsHalf(true);
  const auto flags = openvdb::BoolGrid::create(true);
  flags->setName("bool");
  flags->tree().setValueOn(Coord(1, 2, 3), false);
  files.write({density, small, flags, made<FloatGrid>("float", 0.1f), made<openvdb::Int32Grid>("int32", -7),
               made<openvdb::Int64Grid>("int64", 1ll << 40),
               made<Vec3SGrid>("vec3s", Vec3s(1.0f, 2.0f, 0.1f)),
               made<openvdb::Vec3DGrid>("vec3d", Vec3d(1.0, 2.0, 0.1)),
               made<openvdb::Vec3IGrid>("vec3i", openvdb::Vec3i(1, 2, 3))});
  const Coord place(2, -4, 3);
  const auto got = scalars(files.file, "double");
  CHECK(got->tree().getValue(place) == 0.1f);
  CHECK(got->background() == 2.5f);
  CHECK(got->tree().getValue(Coord(100)) == 7.0f);
  CHECK(got->tree().getValue(Coord(260)) == -1.0f);
  CHECK(got->tree().hasSameTopology(density->tree()));
  CHECK(got->activeVoxelCount() == density->activeVoxelCount());
  CHECK(got->getGridClass() == openvdb::GRID_FOG_VOLUME);
  CHECK(got->transform() == density->transform());
  CHECK(got->getName() == "double");
  CHECK(scalars(files.file, "half")->tree().getValue(place) == float(openvdb::math::half(0.1f)));
  CHECK_FALSE(scalars(files.file, "half")->saveFloatAsHalf());
  CHECK(scalars(files.file, "float")->tree().getValue(place) == 0.1f);
  CHECK(scalars(files.file, "int32")->tree().getValue(place) == -7.0f);
  CHECK(scalars(files.file, "int64")->tree().getValue(place) == std::ldexp(1.0f, 40));
  CHECK(scalars(files.file, "bool")->background() == 1.0f);
  CHECK(scalars(files.file, "bool")->tree().getValue(Coord(1, 2, 3)) == 0.0f);
  CHECK(scalars(files.file, "bool")->activeVoxelCount() == 1);
  CHECK(vectors(files.file, "vec3s")->tree().getValue(place) == Vec3s(1.0f, 2.0f, 0.1f));
  CHECK(vectors(files.file, "vec3d")->tree().getValue(place) == Vec3s(1.0f, 2.0f, 0.1f));
  CHECK(vectors(files.file, "vec3i")->tree().getValue(place) == Vec3s(1.0f, 2.0f, 3.0f));
}

TEST_CASE("grid: a class that lies, and inactive values, are given as they are", "[foreign]") {
  const Files files;
  // Distances in voxels, some in tiles, background 0.
  const auto phi = made<FloatGrid>("phi", -7.0f);
  phi->setGridClass(openvdb::GRID_LEVEL_SET);
  phi->fill(openvdb::CoordBBox(Coord(8), Coord(15)), 5.0f);
  phi->tree().setValueOff(Coord(0, 0, 4), 3.0f);
  phi->setSaveFloatAsHalf(true);
  files.write({phi});
  const auto got = scalars(files.file, "phi");
  CHECK(got->getGridClass() == openvdb::GRID_LEVEL_SET);
  CHECK(got->background() == 0.0f);
  CHECK(got->tree().getValue(Coord(12)) == 5.0f);
  CHECK(got->tree().getValue(Coord(0, 0, 4)) == 3.0f);
  CHECK(got->tree().hasSameTopology(phi->tree()));
}

TEST_CASE("grid: of several with one name the first, and all in the list", "[foreign]") {
  const Files files;
  files.write({made<FloatGrid>("a", 1.0f), made<FloatGrid>("b", 2.0f), made<FloatGrid>("b", 3.0f)});
  CHECK(scalars(files.file, "b")->tree().getValue(Coord(0, 0, 3)) == 2.0f);
  const auto heads = listGrids(files.file);
  REQUIRE(heads.size() == 3);
  CHECK(heads[1].name == "b");
  CHECK(heads[2].name == "b");
}

TEST_CASE("grid: any affine transform, index to world", "[foreign]") {
  const Files files;
  const auto grid = made<FloatGrid>("a", 1.0f);
  const auto check = [&](const openvdb::math::Transform::Ptr& transform) {
    grid->setTransform(transform);
    files.write({grid});
    const auto heads = listGrids(files.file);
    REQUIRE(heads.size() == 1);
    REQUIRE(heads[0].transform);
    CHECK(heads[0].readable);
    const auto& m = *heads[0].transform;
    const Vec3d index(1.5, -2.0, 7.0), world = transform->indexToWorld(index);
    for (std::size_t row = 0; row < 3; ++row)
      CHECK(m[4 * row] * index[0] + m[4 * row + 1] * index[1] + m[4 * row + 2] * index[2] + m[4 * row + 3] ==
            Approx(world[int(row)]));
    for (std::size_t i = 12; i < 16; ++i) CHECK(m[i] == (i == 15 ? 1.0 : 0.0));
    const Vec3d got = scalars(files.file, "a")->indexToWorld(index);
    CHECK((got - world).length() < 1e-12);
  };
  const auto transform = openvdb::math::Transform::createLinearTransform(0.1);
  check(transform);
  transform->postTranslate(Vec3d(10.0, -20.0, 0.3));
  check(transform);
  transform->preScale(Vec3d(1.0, 2.0, 3.0));
  check(transform);
  transform->postRotate(0.7, openvdb::math::X_AXIS);
  transform->postRotate(0.4, openvdb::math::Z_AXIS);
  check(transform);
  transform->postShear(0.3, openvdb::math::X_AXIS, openvdb::math::Y_AXIS);
  check(transform);
  check(openvdb::math::Transform::createLinearTransform(1e-4));
}

TEST_CASE("grid: transforms that are not affine or lead nowhere are listed and refused", "[foreign]") {
  const Files files;
  const auto grid = made<FloatGrid>("smoke", 1.0f);
  const auto refused = [&] {
    const auto heads = listGrids(files.file);
    REQUIRE(heads.size() == 2);
    CHECK_FALSE(heads[0].transform);
    CHECK_FALSE(heads[0].readable);
    CHECK(heads[1].readable);
    CHECK_THROWS_WITH(readGrid(files.file, "smoke", false),
                      Contains("grid \"smoke\" has a transform that is not affine or leads nowhere"));
  };
  const auto other = made<FloatGrid>("other", 1.0f);
  grid->setTransform(openvdb::math::Transform::createFrustumTransform(
      openvdb::BBoxd(Vec3d(0.0), Vec3d(100.0)), 0.5, 10.0, 0.1));
  files.write({grid, other});
  refused();

  // A scale of nothing along one axis.
  grid->setTransform(std::make_shared<openvdb::math::Transform>(
      std::make_shared<openvdb::math::ScaleMap>(Vec3d(0.5, 0.25, 0.123456789))));
  files.write({grid, other});
  const double scale = 0.123456789, nothing = 0.0;
  std::string word(8, '\0'), zero(8, '\0');
  std::memcpy(word.data(), &scale, 8);
  std::memcpy(zero.data(), &nothing, 8);
  const std::string whole = readBytes(files.file);
  files.writeBytes(renamed(whole, word, zero));
  refused();
}

TEST_CASE("grid: one of an unknown type is listed, and hinders no other", "[foreign]") {
  const Files files;
  // Points of an unknown kind: of floats, under another name.
  const auto particles = made<openvdb::Int32Grid>("particles", 1);
  files.write({made<FloatGrid>("phi", 1.0f), particles, made<Vec3SGrid>("velocity", Vec3s(2.0f))});
  files.writeBytes(renamed(readBytes(files.file), "Tree_int32_5_4_3", "Tree_point_5_4_3"));
  const auto heads = listGrids(files.file);
  REQUIRE(heads.size() == 3);
  CHECK(heads[1].name == "particles");
  CHECK(heads[1].type == "Tree_point_5_4_3");
  CHECK_FALSE(heads[1].readable);
  CHECK(heads[1].activeVoxels == 20);
  CHECK(heads[2].name == "velocity");
  CHECK(vectors(files.file, "velocity")->tree().getValue(Coord(0, 0, 3)) == Vec3s(2.0f));
  CHECK_FALSE(readGrid(files.file, true).empty());
  CHECK_THROWS_WITH(readGrid(files.file, "particles", false),
                    Contains("holds values of the type Tree_point_5_4_3, and single numbers are needed"));
}

TEST_CASE("grid: a file that was written as a stream, whose grids lie nowhere in particular", "[foreign]") {
  const Files files;
  std::ostringstream out;
  openvdb::io::Stream(out).write(
      openvdb::GridCPtrVec{made<FloatGrid>("phi", 1.0f), made<Vec3SGrid>("velocity", Vec3s(2.0f)),
                           made<openvdb::Int32Grid>("k", 1), made<FloatGrid>("behind", 1.0f)});
  files.writeBytes(out.str());
  CHECK(listGrids(files.file).size() == 4);
  CHECK(scalars(files.file, "behind")->tree().getValue(Coord(0, 0, 3)) == 1.0f);
  CHECK(vectors(files.file, "velocity")->tree().getValue(Coord(0, 0, 3)) == Vec3s(2.0f));
  files.writeBytes(renamed(out.str(), "Tree_int32_5_4_3", "Tree_point_5_4_3"));
  CHECK(listGrids(files.file).size() == 3);
  CHECK(vectors(files.file, "velocity")->tree().getValue(Coord(0, 0, 3)) == Vec3s(2.0f));
}

TEST_CASE("grid: two that share a tree", "[foreign]") {
  const Files files;
  const auto a = made<FloatGrid>("a", 4.0f);
  const FloatGrid::Ptr b = a->copy();  // of the grid, not of its tree
  b->setName("b");
  b->setTransform(openvdb::math::Transform::createLinearTransform(0.5));
  files.write({a, b});
  const auto got = scalars(files.file, "b");
  CHECK(got->tree().getValue(Coord(0, 0, 3)) == 4.0f);
  CHECK(got->voxelSize()[0] == 0.5);
  CHECK(scalars(files.file, "a")->voxelSize()[0] == 1.0);
}

TEST_CASE("grid: a clear word about what is not there", "[foreign]") {
  const Files files;
  files.write({made<FloatGrid>("phi", 1.0f), made<Vec3SGrid>("vel", Vec3s(1.0f))});
  CHECK_THROWS_WITH(readGrid(files.file, "velocity", true),
                    "holds no grid \"velocity\", but these: \"phi\", \"vel\"");
  CHECK_THROWS_WITH(readGrid(files.file, "phi", true), Contains("\"phi\" holds single numbers, and vectors"));
  CHECK_THROWS_WITH(readGrid(files.file, "vel", false),
                    Contains("\"vel\" holds vectors, and single numbers"));
  files.write({});
  CHECK(listGrids(files.file).empty());
  CHECK_THROWS_WITH(readGrid(files.file, "phi", false), "holds no grid \"phi\", and no other");
  files.writeBytes("");
  CHECK_THROWS_WITH(listGrids(files.file), Contains("is no OpenVDB file"));
  CHECK_THROWS_WITH(readGrid(files.file, "phi", false), Contains("is no OpenVDB file"));
  CHECK_THROWS_WITH(listGrids(files.scratch.path / "none.vdb"), Contains("cannot be opened"));
}

TEST_CASE("grid: active values that are not finite are counted", "[foreign]") {
  const Files files;
  const auto velocity = made<Vec3SGrid>("v", Vec3s(1.0f));
  velocity->tree().setValue(Coord(3, -6, 3), Vec3s(0.0f, std::nanf(""), 0.0f));
  velocity->tree().setValue(Coord(-100, 5, 6), Vec3s(0.0f, 0.0f, -kInfinite));
  files.write({velocity});
  CHECK_THROWS_WITH(
      readGrid(files.file, "v", true),
      Contains("grid \"v\" has 2 active voxels without a finite value, the first at (-100, 5, 6)"));
  const auto phi = made<FloatGrid>("p", 1.0f);
  phi->tree().setValueOff(Coord(1, 1, 1), kInfinite);
  files.write({phi});
  CHECK(std::isinf(scalars(files.file, "p")->tree().getValue(Coord(1, 1, 1))));
  phi->fill(openvdb::CoordBBox(Coord(8), Coord(15)), kInfinite);
  files.write({phi});
  CHECK_THROWS_WITH(readGrid(files.file, "p", false),
                    Contains("has 512 active voxels") && Contains("(8, 8, 8)"));
  // Too large for a float.
  files.write({made<DoubleGrid>("d", 1e300)});
  CHECK_THROWS_WITH(readGrid(files.file, "d", false), Contains("has 20 active voxels"));
}

TEST_CASE("grid: read while they come, to the end or not", "[foreign]") {
  const Files files;
  files.write({made<FloatGrid>("a", 1.0f)});
  const std::string whole = readGrid(files.file, "a", false);
  REQUIRE(whole.size() > 100'000);
  std::string got;
  readGrid(files.file, "a", false, [&](std::istream& stream) {
    got.resize(whole.size());
    stream.read(got.data(), std::streamsize(got.size()));
  });
  const std::size_t written = 100;  // when, at the front
  CHECK((got.substr(written) == whole.substr(written)));
  readGrid(files.file, "a", false, [](std::istream&) {});
  CHECK_THROWS_AS(readGrid(files.file, "a", false,
                           [&](std::istream& stream) {
                             got.resize(whole.size() + 1);
                             stream.read(got.data(), std::streamsize(got.size()));
                           }),
                  std::ios_base::failure);
  CHECK_THROWS_AS(readGrid(files.file, "a", false, [](std::istream&) { throw std::out_of_range("own"); }),
                  std::out_of_range);
  // What the reader says is worth more than the failure that its silence leads to.
  CHECK_THROWS_AS(readGrid(files.file, "b", false, [](std::istream& stream) { stream.get(); }), Unreadable);
  CHECK(readGrid(files.file, "a", false).size() == whole.size());
}

TEST_CASE("grid: damaged files are refused or give something whole", "[foreign]") {
  const Files files;
  const auto small = made<Vec3SGrid>("half", Vec3s(1.0f));
  small->setSaveFloatAsHalf(true);
  files.write({made<DoubleGrid>("double", 0.1), small, made<FloatGrid>("last", 2.0f)});
  const std::string whole = readBytes(files.file);
  for (const std::size_t missing : {1u, 9u, 99u, 999u}) {
    files.writeBytes(whole.substr(0, whole.size() - missing));
    CHECK_THROWS_WITH(readGrid(files.file, "last", false), Contains("damaged or cut short"));
    CHECK(listGrids(files.file).size() == 3);
  }
  for (std::size_t size = 0; size < whole.find("double"); size += 7) {
    files.writeBytes(whole.substr(0, size));
    CHECK_THROWS_WITH(listGrids(files.file), Contains("is no OpenVDB file"));
  }
  std::mt19937 random(5);
  for (int round = 0; round < 60; ++round) {
    std::string bytes = whole;
    // Most of it is masks; names, numbers and places lie at the front.
    for (int i = 0; i < 4; ++i) bytes[random() % (round % 2 == 0 ? bytes.size() : 1000)] = char(random());
    files.writeBytes(bytes);
    try {
      listGrids(files.file);
      scalars(files.file, "double");
      vectors(files.file, "half");
    } catch (const Unreadable& error) {
      const std::string words = error.what();
      CHECK(words.size() < 1000);
      CHECK(words.find('\n') == words.npos);
    }
  }
}

TEST_CASE("grid: a list that leads back into itself ends", "[foreign]") {
  const Files files;
  files.write({made<FloatGrid>("phi", 1.0f)});
  // Behind the name, the type and the other's name: where the grid is, its values, and its end.
  std::string bytes = readBytes(files.file);
  const std::size_t end = bytes.find("Tree_float_5_4_3") + 16 + 4 + 16, count = bytes.find("phi") - 8;
  std::memset(&bytes[count], 0x7f, 4);
  std::memset(&bytes[end], 0, 8);
  bytes[end] = char(count + 4);
  files.writeBytes(bytes);
  CHECK_THROWS_WITH(listGrids(files.file), Contains("damaged"));
}
