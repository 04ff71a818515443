#include "sim/volume/regained_surface.h"

#include "sim/surface/level_set.h"
#include "sim/volume/deficit_grid.h"
#include "sim/volume/volume_deficit.h"
#include "tests/sim/step/solver_scenes.h"

#include <catch2/catch.hpp>

using namespace fluidtex::sim;
using Catch::Detail::Approx;

namespace {

constexpr double kVoxel = 1.0 / 16, kCell = kVoxel * kVoxel * kVoxel;

FloatGrid::Ptr owing(const Coord& cell, float share) {
  FloatGrid::Ptr deficit = FloatGrid::create(0.0f);
  deficit->setTransform(cellTransform(kVoxel));
  deficit->tree().setValueOn(cell, share);
  return deficit;
}

}  // namespace

TEST_CASE("regained surface: a deficit in the air becomes liquid where it fills a cell, the sum stays") {
  const auto solid = Solids(tank(16, {})).at(0.0);
  // In the open, and on the floor.
  for (const Coord& cell : {Coord(8, 8, 8), Coord(8, 8, 0)}) {
    for (const float share : {0.4f, 0.8f, 0.95f, 1.0f, 3.0f}) {
      CAPTURE(cell, share);
      const auto phi = makePhi(kVoxel, 6 * kVoxel);
      if (cell[2] == 0) phi->tree().setValue(Coord(8, 8, -1), -0.5f);  // behind the wall, as left from before
      const auto deficit = owing(cell, share);
      Markers markers{{Coord(8, 8, cell[2] & ~7), {{0.0f, 0.0f, static_cast<float>(cell[2] & 7), 0.5f}}}};
      regainSurface(*phi, markers, *deficit, *solid);
      const double shown = liquidVolume(*phi, *solid);
      CHECK(shown == Approx(share < 0.9f ? 0.0 : std::min(share, 1.0f) * kCell).margin(1e-3 * kCell));
      CHECK(shown + totalDeficit(*deficit) == Approx(share * kCell).epsilon(1e-5));
      CHECK(markers.empty() == (share > 0.9f));
    }
  }
}

TEST_CASE("regained surface: liquid beside takes the deficit itself") {
  const auto solid = Solids(tank(16, {})).at(0.0);
  const auto phi = makePhi(kVoxel, 6 * kVoxel);
  phi->tree().setValue(Coord(8, 8, 7), static_cast<float>(-kVoxel));
  const auto deficit = owing(Coord(8, 8, 8), 0.95f);
  Markers markers;
  regainSurface(*phi, markers, *deficit, *solid);
  CHECK(phi->tree().getValue(Coord(8, 8, 8)) > 0.0f);
}

TEST_CASE("regained surface: liquid of a source with a velocity takes nothing") {
  const auto solid = Solids(tank(16, {})).at(0.0);
  for (const bool flowing : {true, false}) {
    const auto phi = makePhi(kVoxel, 6 * kVoxel);
    phi->tree().setValue(Coord(8, 8, 7), static_cast<float>(-kVoxel));
    SourceGrids source;
    source.phi = phi->deepCopy();
    if (flowing) source.velocity.fill(FloatGrid::create(0.0f));
    RunningFlows flows;
    flows.sources.push_back({&source, 1.0});
    const auto deficit = owing(Coord(8, 8, 8), 0.95f);
    Markers markers;
    regainSurface(*phi, markers, *deficit, *solid, flows);
    CHECK((phi->tree().getValue(Coord(8, 8, 8)) < 0.0f) == flowing);
  }
}

TEST_CASE("regained surface: a speck that shows liquid where none is left is withdrawn, the sum stays") {
  const auto solid = Solids(tank(16, {})).at(0.0);
  const Coord cell(8, 8, 8);
  for (const float left : {0.0f, 0.2f}) {
    const auto phi = makePhi(kVoxel, 6 * kVoxel);
    phi->tree().setValueOn(cell, static_cast<float>(-0.02 * kVoxel));
    const double shown = liquidVolume(*phi, *solid);
    REQUIRE(shown > 0.4 * kCell);
    const auto deficit = owing(cell, left - static_cast<float>(shown / kCell));
    Markers markers{{Coord(8, 8, 8), {{0.0f, 0.0f, 0.0f, -0.1f}, {3.0f, 0.0f, 0.0f, -0.1f}}}};
    withdrawSurface(*phi, markers, *deficit, *solid);
    const double after = liquidVolume(*phi, *solid);
    CHECK(after == Approx(left > 0.1f ? shown : 0.0).margin(1e-9));
    CHECK(after + totalDeficit(*deficit) == Approx(left * kCell).margin(1e-6 * kCell));
    CHECK(markers[0].markers.size() == (left > 0.1f ? 2 : 1));
  }
}

TEST_CASE("regained surface: a drop that splashes onto the floor comes to rest as a puddle") {
  Options options = tank(24, {});
  options.viscosity = 600.0;
  options.walls.push_back({DomainFace::all, {.kind = WallKind::noSlip}});
  options.liquid.resize(1);
  options.liquid[0].shape = {Sphere{Vec3d(0.183, 0.674, 0.438), 0.057}};  // less than three cells across
  Solver solver(options);
  FrameStats stats = solver.next().stats;
  const double poured = stats.volume + stats.deficit;
  for (int n = 0; n < 30; ++n) {
    stats = solver.next().stats;
    REQUIRE(stats.volume + stats.deficit == Approx(poured).epsilon(1e-4));
  }
  CHECK(stats.volume > 0.5 * poured);
}
