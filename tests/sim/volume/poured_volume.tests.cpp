#include "sim/volume/poured_volume.h"

#include "sim/step/solver.h"
#include "sim/surface/settle_surface.h"
#include "sim/volume/deficit_grid.h"
#include "tests/sim/volume/ball_and_flow.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex::sim;

namespace {

double noSolids(const Vec3d&) {
  return 1.0;
}

// The deficit of a body that is poured into an empty tank.
double deficitOf(const std::function<double(const Vec3d&)>& distance, bool start) {
  const SolidField solid = box();
  const FloatGrid::Ptr bodies = phiOf(distance), settled = bodies->deepCopy();
  settleSurface(*settled, solid);
  const PouredLiquid poured{*bodies, *bodies, distance, noSolids, start};
  const FloatGrid::Ptr deficit = withPoured(nullptr, poured, *settled, solid, {});
  return deficit ? totalDeficit(*deficit) : 0.0;
}

}  // namespace

TEST_CASE("poured volume: a film without a cell's centre is all deficit", "[sim]") {
  // 0.3 cells thick, between the centres at 16.5 and 17.5.
  const auto film = [](const Vec3d& x) {
    const Vec3d far(std::abs(x[0] - 0.5) - 0.25, std::abs(x[1] - 0.5) - 0.25,
                    std::abs(x[2] - 17.0 * kVoxel) - 0.15 * kVoxel);
    const Vec3d out = openvdb::math::maxComponent(far, Vec3d(0.0));
    return out.lengthSqr() > 0.0 ? out.length() : std::max({far[0], far[1], far[2]});
  };
  for (const bool start : {true, false})
    CHECK(deficitOf(film, start) == Approx(0.25 * 0.3 * kVoxel).epsilon(0.05));
}

TEST_CASE("poured volume: of a pool and of a large ball there is next to none", "[sim]") {
  CHECK(std::abs(deficitOf([](const Vec3d& x) { return x[2] - 0.5; }, true)) < 1e-5);
  CHECK(std::abs(deficitOf(ball, true)) < 0.01 * 4.19 * 0.008);
}

TEST_CASE("poured volume: what was there before is kept", "[sim]") {
  const SolidField solid = box();
  const FloatGrid::Ptr bodies = phiOf(ball), settled = bodies->deepCopy();
  settleSurface(*settled, solid);
  const auto earlier = FloatGrid::create(0.0f);
  earlier->setTransform(cellTransform(kVoxel));
  earlier->tree().setValueOn(Coord(2, 2, 2), 0.5f);
  const FloatGrid::Ptr deficit =
      withPoured(earlier.get(), {*bodies, *bodies, ball, noSolids, false}, *settled, solid, {});
  REQUIRE(deficit);
  CHECK(deficit->tree().getValue(Coord(2, 2, 2)) == 0.5f);
}

TEST_CASE("poured volume: of a body that begins in a wall nothing is owed on the wall's other side") {
  // The body begins at the centre of a cell that is open on the other side, up to a quarter of it.
  Options options;
  options.size = Vec3d(16.0);
  options.resolution = 16;
  Solid wall;
  wall.shape = {Box{Vec3d(6.25, -1.0, -1.0), Vec3d(9.3, 17.0, 17.0)}};
  options.solids.push_back(wall);
  options.liquid.push_back({{Box{Vec3d(6.5, 0.0, 0.0), Vec3d(16.0, 16.0, 5.0)}}});
  const Frame frame = Solver(options).next();
  CHECK(frame.stats.volume + frame.stats.deficit == Approx(6.7 * 16.0 * 5.0).epsilon(0.01));
}
