#include "tools/stress_scenes/random_scene.h"

#include "scenes/scene.h"
#include "tests/scratch.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <fstream>
#include <set>
#include <string>
#include <variant>

using namespace fluidtex;

TEST_CASE("random scenes: the same number of the same seed is the same scene, others are others",
          "[stress]") {
  std::set<std::string> all;
  for (int number = 0; number < 50; ++number) {
    const std::string text = stress::textOf(stress::randomScene(3, number));
    CHECK(text == stress::textOf(stress::randomScene(3, number)));
    all.insert(text.substr(text.find('\n')));
    const std::string other = stress::textOf(stress::randomScene(4, number));
    all.insert(other.substr(other.find('\n')));
  }
  CHECK(all.size() == 100);
}

TEST_CASE("random scenes: the loader takes them all, and they are as large as they should be", "[stress]") {
  const Scratch scratch;
  const auto file = scratch.path / "scene.toml";
  for (int number = 0; number < 300; ++number) {
    std::ofstream(file) << stress::textOf(stress::randomScene(1, number));
    INFO("scene " << number);
    scenes::Scene scene;
    REQUIRE_NOTHROW(scene = scenes::loadScene(file));
    CHECK(scene.frames == 20);
    CHECK(scene.sim.resolution >= 24);
    CHECK(scene.sim.resolution <= 32);
  }
}

TEST_CASE("random scenes: in a fifth of them all boxes lie on quarters of cells", "[stress]") {
  const Scratch scratch;
  const auto file = scratch.path / "scene.toml";
  int aligned = 0, count = 0;
  for (int number = 0; number < 300; ++number) {
    std::ofstream(file) << stress::textOf(stress::randomScene(1, number));
    const sim::Options options = scenes::loadScene(file).sim;
    bool any = false, all = true;
    for (const sim::LiquidBody& body : options.liquid) {
      const auto* const box = std::get_if<sim::Box>(&body.shape.kind);
      if (box == nullptr) continue;
      any = true;
      for (int a = 0; a < 3; ++a) {
        for (const double x : {box->min[a], box->max[a]}) {
          const double quarters = 4.0 * x / options.voxelSize();
          all = all && std::abs(quarters - std::round(quarters)) < 1e-6;
        }
      }
    }
    count += any ? 1 : 0;
    aligned += any && all ? 1 : 0;
  }
  CHECK(count > 150);
  CHECK(aligned > 0.1 * count);
  CHECK(aligned < 0.3 * count);
}
