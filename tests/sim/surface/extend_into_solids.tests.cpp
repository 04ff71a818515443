#include "sim/surface/extend_into_solids.h"

#include "tests/sim/surface/surface_scene.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace fluidtex::sim;

namespace {

constexpr double kFloorCell = 1.0 / 32;

// The floor z < 0.25, in the middle of cells' height.
FloatGrid::Ptr floorBelow() {
  FloatGrid::Ptr solid = makePhi(kFloorCell, 3 * kFloorCell);
  unite(
      *solid, [](const Vec3d& x) { return x.z() - 0.25; }, grown(firstCells(Coord(32)), 8));
  return solid;
}

// Whether phi is the plane's distance in cells of the floor up to so many cells deep; gives how many were
// looked at.
int checkPlaneIn(const FloatGrid& solid, const FloatGrid& phi, const Distance& plane, float deepest,
                 double farthest) {
  const double h = kFloorCell;
  int checked = 0;
  for (auto it = phi.cbeginValueOn(); it; ++it) {
    const float depth = -solid.tree().getValue(it.getCoord());
    const Vec3d x = phi.indexToWorld(it.getCoord());
    if (depth < 0.5f * h || depth > deepest * h || std::abs(plane(x)) > farthest * h) continue;
    if (x.x() < 0.2 || x.x() > 0.8) continue;
    CHECK(std::abs(*it - plane(x)) < 0.02 * h);
    ++checked;
  }
  return checked;
}

Distance planeAlong(const Vec3d& normal) {
  return [unit = normal.unit()](const Vec3d& x) { return (x - Vec3d(0.5, 0.5, 0.3)).dot(unit); };
}

}  // namespace

TEST_CASE("extend into solids: the surface goes on straight into a floor") {
  // Liquid below a slanted plane.
  const double h = kFloorCell;
  const Distance plane = planeAlong(Vec3d(1.0, 0.0, 0.5));
  Surface f(h, Coord(32), plane);
  const FloatGrid::Ptr solid = floorBelow();
  for (auto it = f.phi->beginValueOn(); it; ++it) {
    if (solid->tree().getValue(it.getCoord()) < -0.5f * h) it.setValue(static_cast<float>(-5 * h));
  }
  // Nothing has separated: constant along the floor's normal, as the slope into the floor is falling: linear.
  extendIntoSolids(*f.phi, *solid, {[](const Coord&) { return false; }, [](const Coord&) { return true; }});
  CHECK(checkPlaneIn(*solid, *f.phi, plane, 2.6f, 3.0) > 100);
}

TEST_CASE(
    "extend into solids: the air behind a wall that cuts the surface is none that the liquid has separated "
    "from") {
  // The liquid overhangs the floor, so that there is air below its last cells.
  const Distance plane = planeAlong(Vec3d(1.0, 0.0, -0.4));
  Surface f(kFloorCell, Coord(32), plane);
  const FloatGrid::Ptr solid = floorBelow();
  // What has separated is read off phi itself, time after time.
  for (int n = 0; n < 10; ++n) extendIntoSolids(*f.phi, *solid, {});
  CHECK(checkPlaneIn(*solid, *f.phi, plane, 1.5f, 2.0) > 50);
}

TEST_CASE(
    "extend into solids: liquid that rests on a floor goes on below it, liquid that has separated does not") {
  const double h = kFloorCell;
  // A layer whose lower side is a fifth of a cell above the floor at z = 0.25.
  const Distance layer = [&](const Vec3d& x) { return std::abs(x.z() - 0.4) - (0.15 - 0.2 * h); };
  const FloatGrid::Ptr solid = floorBelow();
  for (const bool separated : {false, true}) {
    Surface f(h, Coord(32), layer);
    extendIntoSolids(*f.phi, *solid,
                     {[&](const Coord&) { return separated; }, [](const Coord&) { return true; }});
    const float below = f.phi->tree().getValue(Coord(16, 16, 7)),
                above = f.phi->tree().getValue(Coord(16, 16, 8));
    CHECK(above < 0.0f);
    if (separated) {
      CHECK(std::abs(below - 0.7 * h) < 0.02 * h);  // the gap stays where it is
    } else {
      CHECK(below < 0.0f);
    }
  }
}
