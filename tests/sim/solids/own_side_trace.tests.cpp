#include "sim/solids/own_side_trace.h"

#include "sim/solids/solids.h"
#include "tests/sim/step/solver_scenes.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex::sim;
using Catch::Detail::Approx;

namespace {

// Across x from 15.7 to 16.3 of 32 cells.
std::shared_ptr<const SolidField> plate() {
  Options options = tank(32, {});
  options.solids.resize(1);
  options.solids[0].shape = {Box{Vec3d(15.7 / 32, -1.0, -1.0), Vec3d(16.3 / 32, 2.0, 2.0)}};
  return Solids(options).at(0.0);
}

}  // namespace

TEST_CASE("own-side trace: beside a thin wall nothing of the flow behind it is read") {
  // Before it, liquid goes along y at 0.5 cells a step, behind it at -2.
  const auto solid = plate();
  const auto speed = [](int axis, const Vec3f& x) {
    if (axis != 1) return 0.0f;
    const float part = std::min(std::max(x[0] - 15.5f, 0.0f), 1.0f);  // linear between the samples
    return 0.5f - 2.5f * part;
  };
  const OwnSideTrace trace(*solid->visibility, Coord(0), speed);
  const auto from = [&](float x) {
    const Vec3f start(x, 10.2f, 10.5f);
    return trace(start, trace.cellAt(start));
  };
  for (const float x : {13.0f, 15.5f, 15.69f}) CHECK(from(x) == Vec3f(x, 10.7f, 10.5f));
  for (const float x : {16.31f, 16.5f, 18.0f}) CHECK(from(x) == Vec3f(x, 8.2f, 10.5f));
  // A trace that begins or ends beside the wall is made anew, another is kept.
  const Vec3f start(15.6f, 10.2f, 10.5f), wrong(15.6f, 9.0f, 10.5f), away(5.0f, 10.0f, 10.5f);
  CHECK(trace.corrected(start, trace.cellAt(start), wrong) == Vec3f(15.6f, 10.7f, 10.5f));
  CHECK(trace.corrected(away, trace.cellAt(away), away) == away);
}

TEST_CASE("own-side trace: liquid driven against a thin wall reads the velocity at the wall, not behind it") {
  // Liquid goes against it at a cell a step and along it at 0.5; behind, along at -2.
  const auto solid = plate();
  const auto speed = [](int axis, const Vec3f& x) {
    if (axis == 0) return x[0] < 16.0f ? 1.0f : 0.0f;
    return axis == 1 ? (x[0] <= 15.5f ? 0.5f : -2.0f) : 0.0f;
  };
  const OwnSideTrace trace(*solid->visibility, Coord(0), speed);
  const Vec3f start(15.4f, 10.2f, 10.5f);
  CHECK(trace(start, Coord(15, 10, 10))[1] == Approx(10.7f));
}

TEST_CASE("own-side trace: where all is visible it is third order") {
  // A turn by a tenth of a radian.
  const Visibility none;
  const auto speed = [](int axis, const Vec3f& x) {
    return axis == 0 ? -0.1f * x[1] : (axis == 1 ? 0.1f * x[0] : 0.0f);
  };
  const OwnSideTrace trace(none, Coord(0), speed);
  const Vec3f to = trace(Vec3f(3.0f, 0.0f, 1.0f), Coord(3, 0, 1));
  CHECK(to[0] == Approx(3.0 * std::cos(0.1)).margin(2e-5));
  CHECK(to[1] == Approx(3.0 * std::sin(0.1)).margin(2e-5));
}
