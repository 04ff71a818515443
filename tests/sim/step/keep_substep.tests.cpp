#include "sim/step/keep_substep.h"

#include "sim/solids/solids.h"
#include "sim/step/solver.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex::sim;

TEST_CASE("substep: kept along the surface and the walls, left out deep in the liquid", "[sim]") {
  Options options;
  options.resolution = 56;
  options.liquid = {{{Box{Vec3d(0.0), Vec3d(0.8, 1.0, 0.9)}}}};
  Solver solver(options);
  for (int n = 1; n <= 3; ++n) solver.next();
  const State before = solver.state();
  const std::shared_ptr<const SolidField> solid = Solids(options).at(0.0);
  const openvdb::FloatGrid::ConstPtr surface = solver.next().surfacePhi;
  const Substep kept = keepSubstep(0.01, before.velocity, *before.phi, {solid->phi.get()});
  const FloatGrid::ConstPtr components[3] = {kept.u, kept.v, kept.w};
  const auto& whole = before.velocity.component;
  const float h = static_cast<float>(options.voxelSize());
  for (int axis = 0; axis < 3; ++axis) {
    CHECK(whole[axis]->tree().probeConstLeaf(Coord(16, 24, 16)) != nullptr);
    CHECK(components[axis]->tree().probeConstLeaf(Coord(16, 24, 16)) == nullptr);
    CHECK(components[axis]->transform() == whole[axis]->transform());
    // All that an interpolation on the surface after the step reads.
    int missing = 0, read = 0;
    for (auto leaf = whole[axis]->tree().cbeginLeaf(); leaf; ++leaf) {
      for (auto value = leaf->cbeginValueOn(); value; ++value) {
        const Coord& at = value.getCoord();
        if (std::abs(surface->tree().getValue(at)) > 2.0f * h) continue;
        ++read;
        missing += !components[axis]->tree().isValueOn(at) || components[axis]->tree().getValue(at) != *value;
      }
    }
    CHECK(read > 10000);
    CHECK(missing == 0);
  }
}
