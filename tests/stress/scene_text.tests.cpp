#include "tools/stress_scenes/scene_text.h"

#include "scenes/scene.h"
#include "tests/scratch.h"

#include <catch2/catch.hpp>

#include <fstream>
#include <variant>

using namespace fluidtex;
using stress::Vec3d;

namespace {

// The one liquid of a scene whose text says it so.
sim::Shape readBack(const std::string& shape) {
  const Scratch scratch;
  const auto file = scratch.path / "scene.toml";
  std::ofstream(file) << "[domain]\nsize = [1, 1, 1]\n[[liquid]]\n" << shape << "\n";
  scenes::Overrides overrides;
  overrides.liquidOnly = true;
  const scenes::Scene scene = scenes::loadScene(file, overrides);
  REQUIRE(scene.sim.liquid.size() == 1);
  return scene.sim.liquid[0].shape;
}

}  // namespace

TEST_CASE("scene text: nine digits of a number, and no zeros behind them", "[stress]") {
  CHECK(stress::text(0.0) == "0");
  CHECK(stress::text(2.0) == "2");
  CHECK(stress::text(-0.25) == "-0.25");
  CHECK(stress::text(1.0 / 3.0) == "0.333333333");
  CHECK(stress::text(200.0 / 3.0) == "66.6666667");
  CHECK(stress::text(1e-7) == "1e-07");
  CHECK(stress::text(Vec3d(1.0, -0.5, 2.0 / 3.0)) == "[1, -0.5, 0.666666667]");
}

TEST_CASE("scene text: shapes come back from a scene's file", "[stress]") {
  const sim::Shape box = readBack(stress::box(Vec3d(0.1, 0.2, 0.3), Vec3d(0.4, 0.5, 0.6)));
  REQUIRE(std::holds_alternative<sim::Box>(box.kind));
  CHECK(std::get<sim::Box>(box.kind).min == Vec3d(0.1, 0.2, 0.3));
  CHECK(std::get<sim::Box>(box.kind).max == Vec3d(0.4, 0.5, 0.6));
  const sim::Shape sphere = readBack(stress::sphere(Vec3d(0.5, 0.25, 0.125), 0.1));
  REQUIRE(std::holds_alternative<sim::Sphere>(sphere.kind));
  CHECK(std::get<sim::Sphere>(sphere.kind).center == Vec3d(0.5, 0.25, 0.125));
  CHECK(std::get<sim::Sphere>(sphere.kind).radius == 0.1);
  const sim::Shape cylinder = readBack(stress::cylinder(Vec3d(0.5, 0.5, 0.1), Vec3d(0.5, 0.5, 0.7), 0.2));
  REQUIRE(std::holds_alternative<sim::Cylinder>(cylinder.kind));
  CHECK(std::get<sim::Cylinder>(cylinder.kind).from == Vec3d(0.5, 0.5, 0.1));
  CHECK(std::get<sim::Cylinder>(cylinder.kind).to == Vec3d(0.5, 0.5, 0.7));
  CHECK(std::get<sim::Cylinder>(cylinder.kind).radius == 0.2);
}

TEST_CASE("scene text: joined shapes keep their order, and may be joined once more", "[stress]") {
  const std::string first = stress::box(Vec3d(0.0), Vec3d(0.5)), second = stress::sphere(Vec3d(0.5), 0.25);
  const sim::Shape shape = readBack(stress::joined(
      "difference", {stress::joined("union", {first, second}), stress::sphere(Vec3d(0.25), 0.125)}));
  REQUIRE(std::holds_alternative<sim::Difference>(shape.kind));
  const auto& parts = std::get<sim::Difference>(shape.kind).parts;
  REQUIRE(parts.size() == 2);
  CHECK(std::get<sim::Sphere>(parts[1].kind).radius == 0.125);
  REQUIRE(std::holds_alternative<sim::Union>(parts[0].kind));
  const auto& joined = std::get<sim::Union>(parts[0].kind).parts;
  REQUIRE(joined.size() == 2);
  CHECK(std::get<sim::Box>(joined[0].kind).max == Vec3d(0.5));
  CHECK(std::get<sim::Sphere>(joined[1].kind).radius == 0.25);
}
