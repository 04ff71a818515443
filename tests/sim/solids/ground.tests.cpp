#include "sim/grid/leaf_table.h"
#include "sim/shapes/height_field.h"
#include "sim/shapes/read_heights.h"
#include "sim/shapes/shape_distance.h"
#include "sim/shapes/shape_triangles.h"
#include "sim/surface/level_set.h"
#include "tests/sim/meshes/written_files.h"

#include <unistd.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

using namespace fluidtex::sim;

namespace {

// A file that goes when the test ends.
struct TemporaryFile {
  inline static int count = 0;
  std::filesystem::path path;

  explicit TemporaryFile(const std::string& text)
      : path(std::filesystem::temp_directory_path() /
             ("fluidtex_ground_" + std::to_string(::getpid()) + "_" + std::to_string(++count) + ".pgm")) {
    std::ofstream(path, std::ios::binary) << text;
  }
  ~TemporaryFile() { std::filesystem::remove(path); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
};

// 64 x 32 pixels of 16 bits: rises evenly from left to right, and from bottom to top by half as much a pixel.
std::string ramp() {
  std::string text = "P5 64 32 65535\n";
  for (int row = 0; row < 32; ++row) {
    for (int column = 0; column < 64; ++column) {
      const int value = 512 * column + 256 * (31 - row);
      text += static_cast<char>(value >> 8);
      text += static_cast<char>(value & 255);
    }
  }
  return text;
}

double volumeOf(const TriangleMesh& mesh) {
  double six = 0.0;
  for (const openvdb::Vec3I& t : mesh.triangles) {
    const Vec3d a(mesh.positions[t[0]]), b(mesh.positions[t[1]]), c(mesh.positions[t[2]]);
    six += a.dot(b.cross(c));
  }
  return six / 6.0;
}

}  // namespace

TEST_CASE("height field: an even slope is a plane, and goes on beyond the domain", "[sim]") {
  const TemporaryFile file(ramp());
  // 2 x 1 m, rising from 0.1 m.
  const HeightField ground{file.path, 1.0 / 32.0, 0.0, 1.0, Vec3d(0.0, 0.0, 0.1)};
  const Vec3d size(2.0, 1.0, 1.0);
  const ShapeDistance distance(Shape{ground}, 1.0 / 32.0, openvdb::BBoxd(Vec3d(0.0), size));
  const double rise = 512.0 / 65535.0 * 32.0, across = 0.5 * rise;
  const auto height = [&](double x, double y) {
    return 0.1 + rise * (x - 1.0 / 64.0) + across * (y - 1.0 / 64.0);
  };
  const double slope = std::sqrt(1.0 + rise * rise + across * across);
  for (double x = 0.5; x < 1.6; x += 0.23) {
    for (double y = 0.4; y < 0.65; y += 0.06) {
      for (const double above : {-0.06, -0.01, 0.0, 0.02, 0.1}) {
        INFO(x << " " << y << " " << above);
        CHECK(std::abs(distance(Vec3d(x, y, height(x, y) + above)) - above / slope) < 1e-4);
      }
    }
  }
  // Its rim goes on, level; near it that is nearer than the plane.
  CHECK(distance(Vec3d(-0.1, 0.5, height(0.0, 0.5) + 0.05)) > 0.03);
  CHECK(distance(Vec3d(2.1, 0.5, height(2.0, 0.5) - 0.05)) < -0.03);
  CHECK(distance(Vec3d(0.5, 0.5, -0.2)) < 0.0);
  // However far.
  CHECK(distance(Vec3d(-300.0, 0.5, height(0.0, 0.5) + 0.05)) > 0.03);
  CHECK(distance(Vec3d(300.0, 90.0, height(2.0, 1.0) - 0.05)) < -0.03);
  CHECK(distance(Vec3d(0.5, 0.5, -300.0)) < 0.0);
}

TEST_CASE("height field: a domain without sides has all of it, and its rim goes on", "[sim]") {
  const TemporaryFile file(ramp());
  // 2 x 1 m, from x = 0.5; the domain would end at x = 1.
  const HeightField ground{file.path, 1.0 / 32.0, 0.0, 1.0, Vec3d(0.5, 0.0, 0.1)};
  openvdb::BBoxd domain(Vec3d(0.0), Vec3d(1.0));
  domain.min()[0] = -kForever;
  domain.max()[0] = kForever;
  const ShapeDistance distance(Shape{ground}, 1.0 / 32.0, domain);
  const double rise = 512.0 / 65535.0 * 32.0;
  const auto height = [&](double x, double y) {
    return 0.1 + rise * (x - 0.5 - 1.0 / 64.0) + 0.5 * rise * (y - 1.0 / 64.0);
  };
  for (const double x : {0.8, 1.2, 1.9}) {
    CHECK(distance(Vec3d(x, 0.5, height(x, 0.5) + 0.05)) > 0.03);
    CHECK(distance(Vec3d(x, 0.5, height(x, 0.5) - 0.05)) < -0.03);
  }
  CHECK(distance(Vec3d(40.0, 0.5, height(2.48, 0.5) + 0.05)) > 0.03);
  CHECK(distance(Vec3d(40.0, 0.5, height(2.48, 0.5) - 0.05)) < -0.03);
  CHECK(distance(Vec3d(-40.0, 0.5, height(0.52, 0.5) + 0.05)) > 0.03);
  CHECK(distance(Vec3d(-40.0, 0.5, height(0.52, 0.5) - 0.05)) < -0.03);
}

TEST_CASE("height field: is drawn closed, within the domain", "[sim]") {
  const TemporaryFile file(ramp());
  const HeightField ground{file.path, 1.0 / 32.0, 0.0, 1.0, Vec3d(0.0, 0.0, 0.1)};
  const TriangleMesh mesh =
      triangulate(Shape{ground}, openvdb::BBoxd(Vec3d(0.0), Vec3d(2.0, 1.0, 1.0)), 1.0 / 16.0);
  const double rise = 512.0 / 65535.0 * 32.0;
  // The mean height over the domain's floor.
  CHECK(volumeOf(mesh) ==
        Approx(2.0 * (0.1 + rise * (1.0 - 1.0 / 64.0) + 0.5 * rise * (0.5 - 1.0 / 64.0))).epsilon(1e-3));
  for (const openvdb::Vec3f& x : mesh.positions)
    CHECK(
        (x.x() >= 0.0f && x.x() <= 2.0f && x.y() >= 0.0f && x.y() <= 1.0f && x.z() >= 0.0f && x.z() <= 1.0f));
}

TEST_CASE("height field: a file that is none is told of", "[sim]") {
  CHECK_THROWS_WITH(readHeights("nowhere.png"), "nowhere.png: no such file");
  CHECK_THROWS_AS(readHeights("."), HeightError);
  const TemporaryFile text("no picture"), dot("P5 1 1 255\nx");
  CHECK_THROWS_AS(readHeights(text.path), HeightError);
  CHECK_THROWS_AS(readHeights(dot.path), HeightError);
  const TemporaryFile cut(ramp().substr(0, 1000));
  CHECK_THROWS_AS(readHeights(cut.path), HeightError);
}

TEST_CASE("height field: heights are as stored, upright, and filled where there are none", "[sim]") {
  // Rises from left to right; the right half nearly transparent.
  std::string grey, both;
  for (int n = 0; n < 64; ++n) {
    grey += static_cast<char>(30 * (n % 8) + n / 8);
    both += grey.back();
    both += static_cast<char>(n % 8 < 4 ? 255 : 10);
  }
  const auto heights = [](const std::string& bytes) {
    const WrittenFile file("heights.tif", bytes);
    return readHeights(file.path);
  };
  const auto value = [](const HeightImage& image, int column, int row) {
    return std::lround(255.0f * image.values[std::size_t(row * image.width + column)]);
  };
  for (const std::uint32_t alpha : {0u, 2u}) {  // not said, and not multiplied in
    const HeightImage image = heights(tiffBytes(8, 8, 8, 2, both, {{338, 3, alpha}}));
    for (int n = 0; n < 64; ++n) REQUIRE(value(image, n % 8, n / 8) == 30 * (n % 8) + n / 8);
  }
  // The eight ways to lie: where the stored first row and first column are in the upright picture (TIFF 6.0).
  for (std::uint32_t orientation = 1; orientation <= 8; ++orientation) {
    const HeightImage image = heights(tiffBytes(8, 4, 8, 1, grey.substr(0, 32), {{274, 3, orientation}}));
    REQUIRE(image.width == (orientation < 5 ? 8 : 4));
    REQUIRE(image.height == (orientation < 5 ? 4 : 8));
    for (int row = 0; row < 4; ++row) {
      for (int column = 0; column < 8; ++column) {
        const int right = 7 - column, bottom = 3 - row;
        const int x[8] = {column, right, right, column, row, bottom, bottom, row};
        const int y[8] = {row, row, bottom, bottom, column, column, right, right};
        CAPTURE(orientation, column, row);
        REQUIRE(value(image, x[orientation - 1], y[orientation - 1]) == 30 * column + row);
      }
    }
  }
  // GDAL_NODATA in whole numbers and in floats; another number as large as none is counts too.
  std::string holes = grey;
  holes[9] = holes[10] = '\xFF';
  const HeightImage filled = heights(tiffBytes(8, 8, 8, 1, holes, {{42113, 2, 0, "255"}}));
  CHECK(value(filled, 0, 1) == 1);
  CHECK((value(filled, 1, 1) == 1 || value(filled, 1, 1) == 30 || value(filled, 1, 1) == 32));
  CHECK(value(filled, 2, 1) != 255);
  for (const float hole : {-3.4028235e38f, -3.4e38f, -9999.0f}) {
    std::string floats;
    for (int n = 0; n < 64; ++n) append(floats, n < 16 ? hole : 0.4f);
    const std::string name = hole == -9999.0f ? "-9999" : "-3.4028234663852886e+38";
    const HeightImage image = heights(tiffBytes(8, 8, 32, 1, floats, {{339, 3, 3}, {42113, 2, 0, name}}));
    for (const float v : image.values) REQUIRE(v == 0.4f);
    if (hole > -1e30f) continue;
    CHECK_THROWS_WITH(
        heights(tiffBytes(8, 8, 32, 1, floats, {{339, 3, 3}})),
        Catch::Matchers::Contains("column 1 of row 1") && Catch::Matchers::Contains("GDAL_NODATA"));
  }
  CHECK_THROWS_WITH(heights(tiffBytes(8, 8, 8, 1, std::string(64, '\7'), {{42113, 2, 0, "7"}})),
                    Catch::Matchers::Contains("no height anywhere"));
}

TEST_CASE("height field: a picture of any kind, and a library that falls over a damaged one", "[sim]") {
  const WrittenFile damaged("heights.sgi", sgiBytes(true)), whole("heights.sgi", sgiBytes(false));
  CHECK_THROWS_WITH(readHeights(damaged.path), Catch::Contains("cannot be read: the library that reads"));
  const HeightImage image = readHeights(whole.path);
  REQUIRE(image.values.size() == 64);
  for (int n = 0; n < 64; ++n)
    REQUIRE(std::lround(255.0f * image.values[std::size_t(n)]) == 30 * (n % 8) + (7 - n / 8));
}

TEST_CASE("height field: mountains above a small domain, and one that has no end", "[sim]") {
  const TemporaryFile file(ramp());
  // A pixel of 30 m, up to 1000 m, in a domain of a metre: a cliff at most.
  HeightField ground{file.path, 30.0, 0.0, 1000.0};
  const openvdb::BBoxd domain(Vec3d(0.0), Vec3d(1.0));
  const TriangleMesh mesh = groundMesh(ground, domain, 1.0 / 32.0, 1.0, -1.0);
  for (const openvdb::Vec3f& x : mesh.positions) REQUIRE(x.z() <= 2.0f);
  CHECK(ShapeDistance(Shape{ground}, 1.0 / 32.0, domain)(Vec3d(0.5, 0.5, 0.5)) > 0.0);
  ground.translate = Vec3d(0.0, 0.0, -100.0);
  CHECK(ShapeDistance(Shape{ground}, 1.0 / 32.0, domain)(Vec3d(0.5, 0.5, 0.5)) > 0.0);
  ground.low = 200.0;
  CHECK(ShapeDistance(Shape{ground}, 1.0 / 32.0, domain)(Vec3d(0.5, 0.5, 0.5)) < 0.0);
  // Beside the domain there is none.
  ground.translate = Vec3d(5.0, 0.0, 0.0);
  CHECK(ShapeDistance(Shape{ground}, 1.0 / 32.0, domain)(Vec3d(0.5, 0.5, 0.5)) > 0.0);
  CHECK_THROWS_WITH(ShapeDistance(Shape{ground}, 1.0 / 32.0),
                    Catch::Matchers::Contains("1.92e+03 x 961 m") && Catch::Matchers::Contains("pixel"));
}

TEST_CASE("cylinder: its distance and its mesh", "[sim]") {
  const Cylinder upright{Vec3d(0.5, 0.5, 0.2), Vec3d(0.5, 0.5, 0.8), 0.1};
  const ShapeDistance distance(Shape{upright}, 0.1);
  CHECK(distance(Vec3d(0.5, 0.5, 0.5)) == Approx(-0.1));
  CHECK(distance(Vec3d(0.5, 0.7, 0.5)) == Approx(0.1));
  CHECK(distance(Vec3d(0.5, 0.5, 0.75)) == Approx(-0.05));
  CHECK(distance(Vec3d(0.55, 0.5, 1.0)) == Approx(0.2));
  CHECK(distance(Vec3d(0.9, 0.5, 1.2)) == Approx(0.5));
  // The same, turned: only the place in its own frame counts.
  const Vec3d along = Vec3d(1.0, 2.0, 2.0) / 3.0, side = Vec3d(2.0, 1.0, -2.0) / 3.0, from(0.1, 0.2, 0.3);
  const ShapeDistance askew(Shape{Cylinder{from, from + 0.6 * along, 0.1}}, 0.1);
  CHECK(askew(from + 0.3 * along + 0.25 * side) == Approx(0.15));
  CHECK(askew(from - 0.4 * along + 0.4 * side) == Approx(0.5));
  const TriangleMesh mesh = triangulate(Shape{upright}, openvdb::BBoxd(Vec3d(0.0), Vec3d(1.0)), 0.005);
  CHECK(volumeOf(mesh) == Approx(std::numbers::pi * 0.01 * 0.6).epsilon(1e-3));
}

TEST_CASE("level set: blocks of liquid are those with a leaf or a tile inside", "[sim]") {
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
