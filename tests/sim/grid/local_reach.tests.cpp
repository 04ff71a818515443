#include "sim/grid/local_reach.h"

#include <catch2/catch.hpp>

using namespace fluidtex::sim;

TEST_CASE("local_reach: that of the fastest value in the leaf and those around it") {
  const double h = 0.25, dt = 0.1;
  Velocity velocity = makeVelocity(h);
  // One leaf flows, by its second component; one touches it at an edge; one lies farther off.
  for (const auto& grid : velocity.component) grid->tree().touchLeaf(Coord(0));
  velocity.component[1]->tree().setValue(Coord(3, 7, 0), -5.0f);
  velocity.component[0]->tree().setValue(Coord(1, 2, 3), 4.0f);
  const LocalReach reach(velocity, dt);
  const auto most = Approx(5.0 * dt / h);
  CHECK(reach.from(Coord(0)) == most);
  CHECK(reach.from(Coord(8, -8, 0)) == most);
  CHECK(reach.from(Coord(-8, -8, -8)) == most);
  CHECK(reach.from(Coord(16, 0, 0)) == 0.0f);
  CHECK(reach.from(Coord(0, 0, -16)) == 0.0f);
}
