#include "tools/stress_scenes/random_scene.h"

#include "scenes/scene.h"
#include "tests/scratch.h"

#include <catch2/catch.hpp>

#include <fstream>
#include <set>

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
