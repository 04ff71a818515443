#include "sim/step/solver.h"
#include "sim/step/state_io.h"
#include "tests/sim/step/solver_scenes.h"

#include <catch2/catch.hpp>

#include <filesystem>

using namespace fluidtex::sim;

TEST_CASE("solver: continued from a file, the same bytes as unbroken") {
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "fluidtex_state_continue.vdb";
  const Options options = tank(24, {box(Vec3d(0.0), Vec3d(0.4, 1.0, 0.5)),
                                    {Shape{Sphere{Vec3d(0.7, 0.5, 0.8), 0.1}}, Vec3d(0.0), 0.09}});
  Solver unbroken(options);
  Frame expected;
  for (int n = 1; n <= 4; ++n) expected = unbroken.next();

  {
    Solver start(options);
    start.next();
    start.next();
    writeState(start.state(), file);
  }
  Solver resumed(options, readState(file));
  std::filesystem::remove(file);
  resumed.next();
  const Frame frame = resumed.next();
  CHECK(resumed.state().frame == 4);
  CHECK(frame.index == 4);
  CHECK(same(*resumed.state().phi, *unbroken.state().phi));
  CHECK(same(*resumed.state().velocity.component[0], *unbroken.state().velocity.component[0]));
  CHECK(same(*resumed.state().velocity.component[1], *unbroken.state().velocity.component[1]));
  CHECK(same(*resumed.state().velocity.component[2], *unbroken.state().velocity.component[2]));
  CHECK(same(*frame.surfacePhi, *expected.surfacePhi));
  CHECK(resumed.state().poured == unbroken.state().poured);
}

TEST_CASE("solver: continued from a file, solids are where they were, though a keyframe is next to a frame") {
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "fluidtex_state_keyframe.vdb";
  Options options = tank(16, {box(Vec3d(0.0), Vec3d(1.0, 1.0, 0.5))});
  Solid paddle;
  paddle.shape.kind = Box{Vec3d(0.2, 0.0, 0.2), Vec3d(0.4, 1.0, 1.0)};
  // Three frames, but for rounding.
  paddle.keyframes = {
      {0.0, Vec3d(0.0), 0.0}, {0.12499997, Vec3d(0.05, 0.0, 0.0), 0.0}, {0.5, Vec3d(0.4, 0.0, 0.0), 0.0}};
  options.solids = {paddle};
  Solver unbroken(options);
  for (int n = 1; n <= 4; ++n) unbroken.next();
  writeState(unbroken.state(), file);
  Solver resumed(options, readState(file));
  std::filesystem::remove(file);
  for (int n = 0; n < 4; ++n) {
    unbroken.next();
    resumed.next();
  }
  CHECK(same(*resumed.state().phi, *unbroken.state().phi));
  CHECK(same(*resumed.state().velocity.component[0], *unbroken.state().velocity.component[0]));
}

TEST_CASE("solver: continued from a file, grids lie where they lay, to the last bit") {
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "fluidtex_state_place.vdb";
  Options options =
      tank(40, {box(Vec3d(0.0), Vec3d(0.4, 1.0, 0.5))});  // cells of 0.05 m: not exact in binary
  options.size = Vec3d(2.0, 1.0, 1.0);
  Solver unbroken(options);
  unbroken.next();
  writeState(unbroken.state(), file);
  const Solver resumed(options, readState(file));
  std::filesystem::remove(file);
  const auto place = [](const FloatGrid& grid) {
    return grid.transform().baseMap()->getAffineMap()->getMat4();
  };
  CHECK(place(*resumed.state().phi) == place(*unbroken.state().phi));
  CHECK(place(*resumed.state().velocity.component[0]) == place(*unbroken.state().velocity.component[0]));
  CHECK(place(*resumed.state().velocity.component[1]) == place(*unbroken.state().velocity.component[1]));
  CHECK(place(*resumed.state().velocity.component[2]) == place(*unbroken.state().velocity.component[2]));
  for (const Vec3d& x : {Vec3d(0.1, 0.2, 0.3), Vec3d(0.7, 0.77, 0.91)})
    CHECK(resumed.state().velocity.component[2]->worldToIndex(x) ==
          unbroken.state().velocity.component[2]->worldToIndex(x));
}

TEST_CASE("solver: a state of another resolution is refused") {
  Solver coarse(tank(16, {box(Vec3d(0.0), Vec3d(0.4, 1.0, 0.5))}));
  coarse.next();
  CHECK_THROWS_AS(Solver(tank(20, {}), coarse.state()), SolverError);
}
