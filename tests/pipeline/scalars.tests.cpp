#include "pipeline/scalars.h"

#include "tests/threads.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace fluidtex;
using namespace fluidtex::pipeline;
using texture::Vec3f;

namespace {

// x + 10 y - 3 z at the nodes of a grid of half a metre, around the origin.
sim::FloatGrid::Ptr slope() {
  openvdb::initialize();
  auto grid = sim::FloatGrid::create(0.0f);
  grid->setTransform(openvdb::math::Transform::createLinearTransform(0.5));
  const openvdb::CoordBBox box(openvdb::Coord(-8), openvdb::Coord(8));
  for (auto c = box.begin(); c; ++c) {
    const openvdb::Vec3d x = grid->indexToWorld(*c);
    grid->tree().setValue(*c, float(x[0] + 10.0 * x[1] - 3.0 * x[2]));
  }
  return grid;
}

// More than one task's share.
std::vector<Vec3f> manyPlaces() {
  std::vector<Vec3f> places;
  for (int i = 0; i < 3000; ++i)
    places.emplace_back(3.0f * std::sin(float(i)), 3.0f * std::cos(1.7f * float(i)), 0.001f * float(i));
  return places;
}

double slopeAt(const Vec3f& x) {
  return double(x[0]) + 10.0 * double(x[1]) - 3.0 * double(x[2]);
}

}  // namespace

TEST_CASE("texture scale: a map is linear between its points and constant beyond") {
  const std::vector<texture::CurvePoint> points{{1.0, 0.5}, {2.0, 1.5}, {4.0, 1.0}};
  CHECK(curveAt(points, -3.0) == 0.5);
  CHECK(curveAt(points, 1.0) == 0.5);
  CHECK(curveAt(points, 1.5) == Approx(1.0));
  CHECK(curveAt(points, 2.0) == Approx(1.5));
  CHECK(curveAt(points, 3.0) == Approx(1.25));
  CHECK(curveAt(points, 9.0) == 1.0);
  CHECK(curveAt({{7.0, 2.0}}, 0.0) == 2.0);
}

TEST_CASE("scalars: a grid is read linearly between its nodes, on any number of threads") {
  const auto grid = slope();
  const std::vector<Vec3f> places = manyPlaces();
  const std::vector<float> values = sampled(*grid, places);
  REQUIRE(values.size() == places.size());
  for (std::size_t i = 0; i < places.size(); ++i) CHECK(values[i] == Approx(slopeAt(places[i])).margin(1e-4));
  CHECK(onThreads(1, [&] { return sampled(*grid, places); }) == values);
  CHECK(onThreads(2, [&] { return sampled(*grid, places); }) == values);
  CHECK(sampled(*grid, {}).empty());
}

TEST_CASE("scalars: along a curve, each place has what stands there for its value") {
  const auto grid = slope();
  const std::vector<Vec3f> places = manyPlaces();
  const std::vector<texture::CurvePoint> points{{-5.0, 0.0}, {5.0, 20.0}};
  const std::vector<float> results = alongCurve(points, places, sampler(*grid));
  REQUIRE(results.size() == places.size());
  for (std::size_t i = 0; i < places.size(); ++i)
    CHECK(results[i] == Approx(std::clamp(10.0 + 2.0 * slopeAt(places[i]), 0.0, 20.0)).margin(1e-3));
}

TEST_CASE("scalars: a frame without what is asked for is named, and what it lacks") {
  sim::Frame frame;
  frame.index = 17;
  const auto heat = sim::FloatGrid::create(1.0f);
  frame.fields["temperature"] = heat;
  CHECK(&fieldOf(frame, "temperature") == heat.get());
  CHECK_THROWS_AS(fieldOf(frame, "age"), std::runtime_error);
  CHECK_THROWS_WITH(fieldOf(frame, "age"), Catch::Contains("frame 17") && Catch::Contains("no age"));
}
