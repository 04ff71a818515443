#include "pipeline/liquid_values.h"

#include <catch2/catch.hpp>

#include <functional>

using namespace fluidtex;
using texture::Vec3f;

namespace {

sim::FloatGrid::ConstPtr gridOf(const std::function<double(const openvdb::Coord&)>& value) {
  openvdb::initialize();
  const auto grid = sim::FloatGrid::create(0.0f);
  grid->setTransform(openvdb::math::Transform::createLinearTransform(0.5));
  for (auto c = openvdb::CoordBBox(openvdb::Coord(-3), openvdb::Coord(3)).begin(); c; ++c)
    grid->tree().setValue(*c, float(value(*c)));
  return grid;
}

}  // namespace

TEST_CASE("liquid values: the frame's fields at the vertices, under names that are free", "[pipeline]") {
  sim::Frame frame;
  frame.fields["heat"] = gridOf([](const openvdb::Coord& c) { return 10.0 * c[0]; });
  frame.fields["age"] = gridOf([](const openvdb::Coord&) { return 3.0; });
  frame.fields["height"] = gridOf([](const openvdb::Coord&) { return 4.0; });
  frame.fields["slope_y"] = gridOf([](const openvdb::Coord&) { return 5.0; });
  texture::TexturedSurface surface;
  surface.positions = {Vec3f(0.25f, 0.0f, 0.0f), Vec3f(1.0f, 0.0f, 0.0f)};
  surface.maps["height"] = {7.0f, 7.0f};  // of the exemplar
  surface.vectors["slope"] = {Vec3f(0.0f), Vec3f(0.0f)};
  pipeline::addLiquidValues(frame, surface);
  CHECK(surface.maps.at("heat") == std::vector<float>{5.0f, 20.0f});
  CHECK(surface.maps.at("height") == std::vector<float>{7.0f, 7.0f});
  CHECK(surface.maps.at("liquid_height") == std::vector<float>{4.0f, 4.0f});
  CHECK(surface.maps.at("liquid_age") == std::vector<float>{3.0f, 3.0f});
  CHECK(surface.maps.at("liquid_slope_y") == std::vector<float>{5.0f, 5.0f});
  CHECK(surface.maps.size() == 5);

  pipeline::setLiquidValues({{"heat", {1.0f, 2.0f}}, {"age", {8.0f, 9.0f}}, {"height", {6.0f, 6.0f}}},
                            surface);
  CHECK(surface.maps.at("heat") == std::vector<float>{1.0f, 2.0f});
  CHECK(surface.maps.at("liquid_age") == std::vector<float>{8.0f, 9.0f});
  CHECK(surface.maps.at("liquid_height") == std::vector<float>{6.0f, 6.0f});
  CHECK(surface.maps.at("height") == std::vector<float>{7.0f, 7.0f});
  CHECK(surface.maps.size() == 5);
}
