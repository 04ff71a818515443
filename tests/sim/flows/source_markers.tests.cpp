// What a source does to markers.
#include "sim/flows/flows.h"
#include "tests/sim/flows/flow_scenes.h"

#include <catch2/catch.hpp>

using namespace fluidtex::sim;

TEST_CASE("flows: a source drops the air markers that it holds, and no others of their cells") {
  Options options;
  options.resolution = 16;
  Source source;
  // Its upper side is a quarter of a cell below the centres of the cells that it cuts.
  source.shape.kind = Box{Vec3d(0.25), Vec3d(0.75, 0.75, 8.25 / 16.0)};
  source.velocity = Vec3d(1.0, 0.0, 0.0);
  options.sources = {source};
  const auto solid = Solids(options).at(0.0);
  // z in cells; markers are measured from the centre of the block's first cell.
  const auto left = [&](float z, float radius) {
    const auto phi = makePhi(1.0 / 16.0, 6.0 / 16.0);
    Markers markers{{Coord(8, 8, 8), {{0.4f, 0.4f, z - 8.5f, radius}}}};
    if (z < 8.5f) markers = {{Coord(8, 8, 0), {{0.4f, 0.4f, z - 0.5f, radius}}}};
    applyFlows(*phi, markers, *solid->phi, Flows(options).at(0.0));
    return !markers.empty();
  };
  CHECK_FALSE(left(8.15f, 0.1f));
  CHECK(left(8.35f, 0.1f));
  CHECK(left(8.15f, -0.1f));
}
