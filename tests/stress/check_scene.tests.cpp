#include "tools/stress_scenes/check_scene.h"

#include "tests/scratch.h"

#include <catch2/catch.hpp>

#include <fstream>
#include <string>

using namespace fluidtex;

namespace {

// That a scene keeps an invariant.
void checkHolds(const std::string& invariant, const std::string& scene) {
  const Scratch scratch;
  std::ofstream(scratch.path / "exemplar.png");  // must be there, but is not read
  const auto file = scratch.path / "scene.toml";
  std::ofstream(file) << "texture.exemplar = \"exemplar.png\"\n" << scene;
  for (const stress::Failure& failure : stress::checkScene(file, scratch.path, invariant))
    FAIL_CHECK(failure.invariant << ": " << failure.what);
}

}  // namespace

TEST_CASE("checks: a drain in liquid with surface tension lays surface open, which is no gain", "[stress]") {
  checkHolds("energy", R"(
frames = 6
domain.size = [1, 1, 1]
domain.resolution = 16
fluid.gravity = [0, 0, 0]
fluid.viscosity = 1e5
fluid.surface_tension = 0.5

[[liquid]]
box = { min = [0, 0, 0], max = [1, 1, 0.6] }

[[drain]]
box = { min = [0.2, 0.2, 0.2], max = [0.8, 0.8, 0.4] }
from = 0.1
)");
}

TEST_CASE("checks: liquid that is poured into the walls of a closed box may run along them", "[stress]") {
  checkHolds("speed", R"(
frames = 8
domain.size = [1, 0.6, 0.7]
domain.resolution = 24
fluid.gravity = [0, 0, 0]

[[liquid]]
box = { min = [0, 0, 0], max = [1, 0.6, 0.24] }
velocity = [-0.43, -0.89, 0.63]
)");
}
