#include "transport/within_reach.h"

#include <catch2/catch.hpp>

#include <limits>

using fluidtex::transport::withinReach;
using openvdb::Vec3d;

TEST_CASE("within reach: indices that an int holds, on each axis, and no NaN", "[transport]") {
  CHECK(withinReach(Vec3d(0.0)));
  CHECK(withinReach(Vec3d(1e9, -1e9, 1e9)));
  for (int axis = 0; axis < 3; ++axis) {
    for (const double far : {1.1e9, -3e9, 1e300, std::numeric_limits<double>::infinity(),
                             std::numeric_limits<double>::quiet_NaN()}) {
      Vec3d index(1.0);
      index[axis] = far;
      CHECK_FALSE(withinReach(index));
    }
  }
}
