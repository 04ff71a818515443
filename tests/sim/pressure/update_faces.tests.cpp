#include "sim/pressure/update_faces.h"

#include "tests/sim/pressure/pressure_scene.h"

#include <catch2/catch.hpp>

#include <vector>

using namespace fluidtex::sim;
using Catch::Matchers::WithinAbs;

namespace {

// A pool of three cells and 0.3 of the fourth, in which gravity has acted for a step.
struct Pool {
  Scene scene{8, {}, [](const Vec3d& x) { return x[2] - 3.3 / 8; }};
  LiquidCells liquid =
      gatherLiquid(*scene.phi, *scene.solid,
                   {&scene.velocity.component[0]->constTree(), &scene.velocity.component[1]->constTree(),
                    &scene.velocity.component[2]->constTree()});
  std::vector<char> attached = std::vector<char>(std::size_t(liquid.numbering.size()), 0);

  // `share` of what holds the pool.
  std::vector<double> pressure(double share) const {
    std::vector<double> q;
    for (int i = 0; i < liquid.numbering.size(); ++i)
      q.push_back(share * kStep * (3.3 - (liquid.numbering.cell(i)[2] + 0.5)));
    return q;
  }
};

}  // namespace

TEST_CASE("update faces: hydrostatic pressure takes what gravity has given, up to the surface", "[sim]") {
  for (const double share : {1.0, 0.25}) {
    Pool pool;
    FloatGrid& w = *pool.scene.velocity.component[2];
    const MaskGrid::Ptr valid =
        updateFaces(pool.liquid, {}, *pool.scene.solid, pool.pressure(share), pool.attached, 2, w);
    for (int k = 1; k <= 3; ++k) {
      const Coord face(4, 4, k);
      CHECK(valid->tree().isValueOn(face));
      CHECK_THAT(w.tree().getValue(face), WithinAbs((share - 1.0) * kStep, 1e-6));
    }
    // The floor is at rest; above the surface nothing is known.
    CHECK(w.tree().getValue(Coord(4, 4, 0)) == 0.0f);
    CHECK(valid->tree().isValueOn(Coord(4, 4, 0)));
    CHECK_FALSE(valid->tree().isValueOn(Coord(4, 4, 4)));
    for (int i = 0; i < pool.liquid.numbering.size(); ++i) {
      const Coord cell = pool.liquid.numbering.cell(i);
      if (cell[0] != 4 || cell[1] != 4) continue;
      // Liquid leaves the lowest cell through its upper face alone.
      const double outflow = projectedOutflow(pool.liquid, {}, pool.pressure(share), i);
      CHECK_THAT(outflow, WithinAbs(cell[2] == 0 ? (share - 1.0) * kStep : 0.0, 1e-6));
    }
  }
}

TEST_CASE("update faces: given velocities are written, whatever the pressure", "[sim]") {
  Pool pool;
  SolidField solid = *pool.scene.solid;
  solid.given = {{FloatGrid::create(0.0f), FloatGrid::create(0.0f), FloatGrid::create(0.0f)}};
  solid.given.component[0]->tree().setValueOn(Coord(4, 4, 1), 3.0f);
  FloatGrid& u = *pool.scene.velocity.component[0];
  const MaskGrid::Ptr valid = updateFaces(pool.liquid, {}, solid, pool.pressure(1.0), pool.attached, 0, u);
  CHECK(u.tree().getValue(Coord(4, 4, 1)) == 3.0f);
  CHECK(u.tree().getValue(Coord(5, 4, 1)) == 0.0f);
  CHECK(valid->tree().isValueOn(Coord(4, 4, 1)));
}

TEST_CASE("update faces: a detached cell lets go of its wall, and is told", "[sim]") {
  Pool pool;
  const Coord cell(4, 4, 0);
  const int number = pool.liquid.numbering.at(cell);
  // It is thrown up.
  pool.scene.setVelocity([](const Vec3d&) { return Vec3d(0.0, 0.0, 1.0); });
  pool.liquid = gatherLiquid(
      *pool.scene.phi, *pool.scene.solid,
      {&pool.scene.velocity.component[0]->constTree(), &pool.scene.velocity.component[1]->constTree(),
       &pool.scene.velocity.component[2]->constTree()});
  std::vector<char> detached = pool.attached;
  detached[std::size_t(number)] = 1;
  const std::vector<double> none(detached.size(), 0.0);
  FloatGrid& w = *pool.scene.velocity.component[2];
  updateFaces(pool.liquid, {}, *pool.scene.solid, none, detached, 2, w);
  CHECK_THAT(w.tree().getValue(cell), WithinAbs(1.0, 1e-6));
  CHECK(w.tree().getValue(Coord(5, 4, 0)) == 0.0f);
  const MaskGrid::Ptr separating = separatingCells(pool.liquid, *pool.scene.solid, detached);
  CHECK(separating->activeVoxelCount() == 1);
  CHECK(separating->tree().isValueOn(cell));
}
