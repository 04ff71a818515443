#include "sim/step/liquid.h"

#include <catch2/catch.hpp>

#include <set>
#include <string>

using namespace fluidtex::sim;

namespace {

Liquid sample(double h) {
  Liquid liquid;
  liquid.phi = makePhi(h, 3.0 * h);
  liquid.phi->tree().setValueOn(Coord(1, 2, 3), float(-h));
  liquid.velocity = makeVelocity(h, liquid.phi->tree());
  return liquid;
}

}  // namespace

TEST_CASE("liquid: every grid is visited once, with the faces it sits at", "[sim]") {
  Liquid liquid = sample(0.1);
  std::set<std::string> names;
  int there = 0;
  forEachGrid(liquid, [&](const char* name, const FloatGrid::Ptr& grid, int axis) {
    CHECK(names.insert(name).second);
    there += grid != nullptr;
    if (grid != nullptr) CHECK((axis == kAtCentres) == (std::string(name) == "phi"));
  });
  CHECK(names.size() == 13);
  CHECK(there == 4);
}

TEST_CASE("liquid: transforms are those of the cells' width", "[sim]") {
  Liquid liquid = sample(0.1);
  liquid.temperature = liquid.phi->deepCopy();
  setTransforms(liquid, 0.25);
  CHECK(liquid.phi->indexToWorld(Coord(0)) == Vec3d(0.125));
  CHECK(liquid.temperature->indexToWorld(Coord(0)) == Vec3d(0.125));
  CHECK(liquid.velocity[1].indexToWorld(Coord(0)) == Vec3d(0.125, 0.0, 0.125));
}

TEST_CASE("liquid: the surface moves with the velocity and the expansion", "[sim]") {
  Liquid liquid = sample(0.1);
  const Coord face(1, 2, 3);
  liquid.velocity.component[2]->tree().setValueOn(face, 2.0f);
  CHECK(movingVelocity(liquid)[2].tree().getValue(face) == 2.0f);
  liquid.expansion = makeVelocity(0.1, liquid.phi->tree());
  liquid.expansion.component[2]->tree().setValueOn(face, 0.5f);
  CHECK(movingVelocity(liquid)[2].tree().getValue(face) == 2.5f);
  CHECK_FALSE(isEmpty(liquid));
  liquid.phi->clear();
  CHECK(isEmpty(liquid));
}
