#include "tools/benchmarks/textured_samples.h"

#include "scenes/exemplars/scales.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <variant>

using namespace fluidtex;

namespace {

// Mean difference between the pixels of two lines; lines are columns or rows.
double stepBetween(const texture::Image& image, int a, int b, bool columns) {
  double sum = 0.0;
  for (int i = 0; i < image.width; ++i)
    for (int c = 0; c < 3; ++c)
      sum += std::abs(
          double(columns ? image.at(a, i)[c] - image.at(b, i)[c] : image.at(i, a)[c] - image.at(i, b)[c]));
  return sum / (3.0 * image.width);
}

}  // namespace

TEST_CASE("textured samples: scales of every size meet at their edges, and are opaque", "[benchmarks]") {
  for (const int size : {64, 128}) {
    CAPTURE(size);
    const texture::Image image = benchmarks::scales(size);
    REQUIRE(image.width == size);
    REQUIRE(image.height == size);
    REQUIRE(image.channels == 4);
    REQUIRE(image.data.size() == std::size_t(4 * size * size));
    for (std::size_t i = 0; i < image.data.size(); ++i) {
      if (i % 4 == 3) REQUIRE(image.data[i] == 1.0f);
      REQUIRE(image.data[i] >= 0.0f);
      REQUIRE(image.data[i] <= 1.0f);
    }
    for (const bool columns : {true, false}) {
      double largest = 0.0;
      for (int i = 0; i + 1 < size; ++i) largest = std::max(largest, stepBetween(image, i, i + 1, columns));
      CHECK(stepBetween(image, size - 1, 0, columns) <= largest);
    }
  }
}

TEST_CASE("textured samples: scales are linear, and as wide in any picture", "[benchmarks]") {
  const texture::Image image = benchmarks::scales(64);
  exemplars::Scales quarter;  // of a picture of 256 pixels
  quarter.size = 64;
  quarter.columns = 4;
  quarter.rows = 6;  // 5 would not meet at the edge
  const std::vector<std::uint8_t> bytes = exemplars::makeGreenScales(quarter);
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const double x = bytes[i] / 255.0;
    const double linear = x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
    REQUIRE(image.data[i / 3 * 4 + i % 3] == Approx(linear).margin(1e-5));
  }
}

TEST_CASE("textured samples: an oriented sphere with the levels asked for", "[benchmarks]") {
  const texture::Surface surface = benchmarks::sphere(1500, 3);
  REQUIRE(surface.levels.size() == 3);
  for (std::size_t level = 0; level < 3; ++level) {
    const texture::SurfaceMesh& mesh = surface.levels[level];
    CHECK(double(mesh.positions.size()) == Approx(1500.0 / std::pow(4.0, double(level))).epsilon(0.1));
    REQUIRE(mesh.orientation.size() == mesh.positions.size());
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      REQUIRE((mesh.positions[v] - texture::Vec3f(0.35f)).length() == Approx(0.15f).epsilon(0.02));
      REQUIRE(mesh.orientation[v].length() == Approx(1.0f).margin(1e-4));
      REQUIRE(std::abs(mesh.orientation[v].dot(mesh.normals[v])) < 1e-3f);
    }
  }
}

TEST_CASE("textured samples: the sheet is that of the scene, on as many cells as points along a side",
          "[benchmarks]") {
  scenes::Overrides overrides;
  overrides.liquidOnly = true;
  const scenes::Scene shipped = scenes::loadScene(FLUIDTEX_SOURCE "/scenes/flows/stretch.toml", overrides);
  const scenes::Scene sheet = benchmarks::stretchedSheet(20000);
  CHECK(sheet.sim.size == shipped.sim.size);
  CHECK(sheet.motion.flow == shipped.motion.flow);
  REQUIRE(sheet.sim.liquid.size() == 1);
  REQUIRE(shipped.sim.liquid.size() == 1);
  const auto& box = std::get<sim::Box>(sheet.sim.liquid[0].shape.kind);
  const auto& same = std::get<sim::Box>(shipped.sim.liquid[0].shape.kind);
  CHECK(box.min == same.min);
  CHECK(box.max == same.max);
  // Half of the points on each of its two sides, a hundred along and across.
  CHECK(sheet.texture.points == 20000);
  CHECK(sheet.sim.resolution == 100);
  // A sheet of 0.08 m takes two and a half cells of no more than this.
  CHECK(benchmarks::stretchedSheet(100).sim.resolution == 48);
}
