#include "sim/solids/trace_end.h"

#include "sim/scalars/advect_scalar.h"
#include "sim/scalars/carried_scalar.h"
#include "sim/solids/solids.h"
#include "sim/velocity/advect_velocity.h"
#include "tests/sim/step/solver_scenes.h"
#include "tests/sim/velocity/velocity_field.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <memory>

using namespace fluidtex::sim;
using Catch::Detail::Approx;
using openvdb::Vec3f;

namespace {

constexpr int kCells = 24;
constexpr double kCell = 1.0 / kCells;

// A plate across x, from so many cells on, and so many thick.
std::shared_ptr<const SolidField> plateAt(double from, double cells) {
  Options options = tank(kCells, {});
  options.solids.resize(1);
  options.solids[0].shape = {Box{Vec3d(from * kCell, -1.0, -1.0), Vec3d((from + cells) * kCell, 2.0, 2.0)}};
  return Solids(options).at(0.0);
}

// From the middle of the cell (x, 10, 10), so many cells along x; in cells of the block (8, 8, 8).
TraceEnd::End traced(const SolidField& solid, int x, float way) {
  TraceEnd end(*solid.phi, solid.visibility.get());
  end.setLeaf(Coord(8), 5);
  const Vec3f start(float(x - 8) + 0.5f, 2.5f, 2.5f);
  return end(((x - 8) << 6) + (2 << 3) + 2, start, start + Vec3f(way, 0.0f, 0.0f));
}

}  // namespace

TEST_CASE("trace end: in the open a trace goes all its way") {
  const auto solid = plateAt(20.0, 0.7);
  const TraceEnd::End end = traced(*solid, 12, 2.25f);
  CHECK(end.place == Vec3f(6.75f, 2.5f, 2.5f));
  CHECK(end.cell == Coord(14, 10, 10));
}

TEST_CASE("trace end: none comes out behind a wall that it is longer than") {
  const double thick = GENERATE(0.6, 1.0, 1.7, 3.0, 4.5);
  CAPTURE(thick);
  const auto solid = plateAt(16.0, thick);
  REQUIRE(solid->visibility != nullptr);
  const TraceEnd::End end = traced(*solid, 15, 4.9f);
  // Seen from before the wall, or from within it where that is one's own side.
  CHECK(end.cell[0] < 16.0 + 0.5 * thick);
  CHECK(end.place[0] - 8.0f < 1.5f + 0.5f * float(thick));
  CHECK(traced(*solid, 15, -3.0f).place[0] == 4.5f);  // away from it
}

TEST_CASE("trace end: in a thick wall it ends half a cell deep") {
  const auto solid = plateAt(14.0, 8.0);
  const TraceEnd::End end = traced(*solid, 12, 4.0f);
  CHECK(end.place[0] >= 6.0f);  // the wall is at 6
  CHECK(end.place[0] <= 7.0f);
}

TEST_CASE("trace end: round the outer edge of a box no value comes from inside it") {
  // Walls of 0.6 cells; the edge is in the cell (12, 12), whose centre lies inside the box.
  Options options = tank(kCells, {});
  options.solids.resize(1);
  const auto corner = [](double cells) { return Box{Vec3d(cells * kCell, cells * kCell, -1.0), Vec3d(2.0)}; };
  options.solids[0].shape = {Difference{{{corner(11.75)}, {corner(12.35)}}}};
  const auto solid = Solids(options).at(0.0);
  TraceEnd end(*solid->phi, solid->visibility.get());
  end.setLeaf(Coord(8), 5);
  const Vec3f start(2.5f, 2.5f, 2.5f);  // the middle of the cell (10, 10, 10)
  const Vec3f place = end.onOwnSide((2 << 6) + (2 << 3) + 2, start, start + Vec3f(1.3f, 1.25f, 0.0f));
  // The cell (11, 11) sees (11, 12) and (12, 11), but not (12, 12): none of it is read.
  REQUIRE(solid->visibility->around(Coord(11, 11, 10)) != nullptr);
  CHECK(std::min(place[0], place[1]) <= 3.5f);
  CHECK(std::max(place[0], place[1]) > 3.5f);
}

TEST_CASE("trace end: velocity and heat do not come through a plate") {
  // Behind the plate it is fast and hot; all moves through it by 3 cells.
  const auto solid = plateAt(12.0, 1.7);
  const FloatGrid::Ptr phi = makePhi(kCell, 6 * kCell);
  for (int n = 0; n < 125; ++n)
    phi->tree().touchLeaf(Coord(8 * (n / 25 - 1), 8 * (n / 5 % 5 - 1), 8 * (n % 5 - 1)))->setValuesOn();
  for (auto it = phi->beginValueOn(); it; ++it) it.setValue(static_cast<float>(-6 * kCell));
  const double middle = 12.85 * kCell;
  const auto flow = [&](const Vec3d& x) { return Vec3d(-1.0, x.x() > middle ? 5.0 : 0.0, 0.0); };
  const Velocity from = velocityField(kCell, phi->tree(), flow);
  Velocity to = makeVelocity(kCell, phi->tree());
  advectVelocity(from, from, to, *phi, *solid->phi, 3.0 * kCell, solid->visibility.get());
  FloatGrid::Ptr heat = makeScalar(*makeScalar(kCell, 300.0), phi->tree());
  for (auto it = heat->beginValueOn(); it; ++it)
    it.setValue(heat->indexToWorld(it.getCoord()).x() > middle ? 1000.0f : 300.0f);
  heat = advectScalar(*heat, from, phi->tree(), *phi, *solid, 3.0 * kCell);
  for (int i = 6; i < 12; ++i) {
    CAPTURE(i);
    CHECK(to.component[1]->tree().getValue(Coord(i, 12, 12)) == 0.0f);
    CHECK(heat->tree().getValue(Coord(i, 12, 12)) == 300.0f);
  }
  CHECK(to.component[1]->tree().getValue(Coord(20, 12, 12)) == Approx(5.0f));
}
