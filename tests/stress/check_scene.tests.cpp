#include "tools/stress_scenes/check_scene.h"

#include "tests/scratch.h"

#include <catch2/catch.hpp>

#include <fstream>

using namespace fluidtex;

TEST_CASE("checks: a drain in liquid with surface tension lays surface open, which is no gain", "[stress]") {
  const Scratch scratch;
  std::ofstream(scratch.path / "exemplar.png");  // must be there, but is not read
  const auto file = scratch.path / "scene.toml";
  std::ofstream(file) << R"(
frames = 6
domain.size = [1, 1, 1]
domain.resolution = 16
texture.exemplar = "exemplar.png"
fluid.gravity = [0, 0, 0]
fluid.viscosity = 1e5
fluid.surface_tension = 0.5

[[liquid]]
box = { min = [0, 0, 0], max = [1, 1, 0.6] }

[[drain]]
box = { min = [0.2, 0.2, 0.2], max = [0.8, 0.8, 0.4] }
from = 0.1
)";
  for (const stress::Failure& failure : stress::checkScene(file, scratch.path, "energy"))
    FAIL_CHECK(failure.invariant << ": " << failure.what);
}
