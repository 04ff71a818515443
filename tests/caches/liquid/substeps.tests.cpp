#include "caches/liquid/substeps.h"

#include "caches/liquid/explained.h"

#include <catch2/catch.hpp>

using namespace fluidtex;
using namespace fluidtex::caches;
using openvdb::Coord;

namespace {

constexpr double kCellSide = 0.1, kFrameSeconds = 0.04;

// One value for all components, such that it is `cells` cells a frame.
sim::FaceGrids evenFlow(double cells, double h = kCellSide) {
  sim::FaceGrids grids = sim::makeVelocity(h);
  for (int axis = 0; axis < 3; ++axis)
    grids.component[std::size_t(axis)]->tree().setValue(Coord(1, 2, 3),
                                                        float(cells * kCellSide / kFrameSeconds));
  return grids;
}

bool isOf(const sim::Substep& substep, const sim::FaceGrids& grids) {
  return substep.u == grids.component[0] && substep.v == grids.component[1] &&
         substep.w == grids.component[2];
}

}  // namespace

TEST_CASE("substeps: one velocity alone is one substep", "[caches]") {
  const sim::FaceGrids begin = evenFlow(7.0), end = evenFlow(9.0);
  const auto first = substepsOf(begin, end, 0.0, kFrameSeconds),
             second = substepsOf(begin, end, 1.0, kFrameSeconds);
  REQUIRE(first.size() == 1);
  CHECK(first[0].dt == kFrameSeconds);
  CHECK(isOf(first[0], begin));
  REQUIRE(second.size() == 1);
  CHECK(second[0].dt == kFrameSeconds);
  CHECK(isOf(second[0], end));
}

TEST_CASE("substeps: one for each two cells of the faster one's motion, up to four", "[caches]") {
  const auto count = [](double begin, double end) {
    return substepsOf(evenFlow(begin), evenFlow(end), 0.5, kFrameSeconds).size();
  };
  CHECK(count(0.0, 0.0) == 1);
  CHECK(count(0.3, 1.9) == 1);
  CHECK(count(0.3, -2.1) == 2);
  CHECK(count(4.1, 1.0) == 3);
  CHECK(count(0.0, 6.1) == 4);
  CHECK(count(0.0, 100.0) == 4);
}

TEST_CASE("substeps: each has the velocity of its middle", "[caches]") {
  const double speed = kCellSide / kFrameSeconds;
  for (const double mean : {0.25, 0.5, 0.75}) {
    const auto substeps = substepsOf(evenFlow(1.0), evenFlow(7.0), mean, kFrameSeconds);
    REQUIRE(substeps.size() == 4);
    double sum = 0.0;
    for (std::size_t n = 0; n < 4; ++n) {
      CHECK(substeps[n].dt == Approx(kFrameSeconds / 4));
      const double expected = 1.0 + 6.0 * weightAt(mean, (double(n) + 0.5) / 4);
      for (const auto& grid : {substeps[n].u, substeps[n].v, substeps[n].w})
        CHECK(grid->tree().getValue(Coord(1, 2, 3)) == Approx(speed * expected));
      sum += expected;
    }
    if (mean == 0.5) CHECK(sum / 4 == Approx(4.0));
  }
}

TEST_CASE("substeps: velocities on grids that lie differently are one behind the other", "[caches]") {
  const sim::FaceGrids begin = evenFlow(7.0), end = evenFlow(7.0, 0.5 * kCellSide);
  const auto substeps = substepsOf(begin, end, 0.25, kFrameSeconds);
  REQUIRE(substeps.size() == 2);
  CHECK(substeps[0].dt == Approx(0.75 * kFrameSeconds));
  CHECK(isOf(substeps[0], begin));
  CHECK(substeps[1].dt == Approx(0.25 * kFrameSeconds));
  CHECK(isOf(substeps[1], end));
}
