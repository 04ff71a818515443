#include "sim/volume/volume_deficit.h"

#include "sim/volume/deficit_grid.h"
#include "tests/sim/volume/ball_and_flow.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace fluidtex::sim;

TEST_CASE("volume deficit: what the surface loses is kept, whatever the flow does") {
  const SolidField solid = box();
  const auto before = phiOf(ballAndFilm), after = phiOf(ball);
  const double lost = liquidVolume(*before, solid) - liquidVolume(*after, solid);
  CHECK(lost > 0.5 * kVoxel);
  const Velocity still = flow([](const Vec3d&) { return Vec3d(0.0); });
  // Nothing comes through the walls, though the flow leads there.
  const Velocity turning =
      flow([](const Vec3d& x) { return Vec3d(0.5 - x[1], x[0] - 0.5, std::sin(3.0 * x[0])); });
  for (const Velocity* velocity : {&still, &turning}) {
    const auto deficit = volumeDeficit({*before, *after}, *velocity, {solid, solid}, {}, 2.5 * kVoxel);
    CHECK(std::abs(sumOf(*deficit) / lost - 1.0) < 1e-4);
    // The same again, when nothing more is lost.
    const auto later =
        volumeDeficit({*after, *after, deficit.get()}, *velocity, {solid, solid}, {}, 2.5 * kVoxel);
    CHECK(std::abs(sumOf(*later) / lost - 1.0) < 1e-4);
  }
}

TEST_CASE("volume deficit: a cell in the open without an open face does no harm") {
  SolidField solid = box();
  const Coord cell(22, 16, 16);  // cut by the ball's surface
  auto& open = solid.open.component;
  for (int axis = 0; axis < 3; ++axis) {
    open[axis] = open[axis]->deepCopy();
    Coord above = cell;
    above[axis] += 1;
    open[axis]->tree().setValueOff(cell, 0.0f);
    open[axis]->tree().setValueOff(above, 0.0f);
  }
  const auto surface = phiOf(ball);
  CHECK(std::abs(surface->tree().getValue(cell)) < 0.5 * kVoxel);
  const Velocity turning = flow([](const Vec3d& x) { return Vec3d(0.5 - x[1], x[0] - 0.5, 0.0); });
  const auto deficit = volumeDeficit({*surface, *surface}, turning, {solid, solid}, {}, 2.5 * kVoxel);
  CHECK(std::isfinite(sumOf(*deficit)));
}

TEST_CASE("volume deficit: none at rest") {
  const SolidField solid = box();
  const auto phi = phiOf(ballAndFilm);
  const auto deficit =
      volumeDeficit({*phi, *phi}, flow([](const Vec3d&) { return Vec3d(0.0); }), {solid, solid}, {}, 1.0);
  CHECK(deficit->empty());
}

TEST_CASE("volume deficit: next to none where the surface goes with the flow") {
  const SolidField solid = box();
  const Vec3d speed(0.5, -0.25, 0.125);
  const double dt = 4.0 * kVoxel, ballVolume = 4.19 * std::pow(0.2, 3);
  const auto before = phiOf(ball), after = phiOf([&](const Vec3d&x) { return ball(x - dt * speed); });
  const auto deficit =
      volumeDeficit({*before, *after}, flow([&](const Vec3d&) { return speed; }), {solid, solid}, {}, dt);
  const double change = liquidVolume(*before, solid) - liquidVolume(*after, solid);
  CHECK(std::abs(sumOf(*deficit) - change) < 1e-5 * ballVolume);
  CHECK(std::abs(change) < 4e-3 * ballVolume);
  // The fluxes blur an edge that is sharp: there is too little liquid on one side of it and too much on the
  // other.
  CHECK(largestOf(*deficit) < 0.1);
  Vec3d moment(0.0);
  for (auto it = deficit->cbeginValueOn(); it; ++it)
    moment +=
        double(*it) * std::pow(kVoxel, 3) * (deficit->indexToWorld(it.getCoord()) - Vec3d(0.5) - dt * speed);
  CHECK(moment.length() < 0.02 * kVoxel * ballVolume);
}

TEST_CASE("volume deficit: beside liquid it lies in the liquid") {
  const SolidField solid = box();
  // A film around the ball, 1.5 cells thick, is lost.
  const auto before = phiOf([](const Vec3d&x) { return ball(x) - 1.5 * kVoxel; }), after = phiOf(ball);
  const auto deficit = volumeDeficit({*before, *after}, flow([](const Vec3d&) { return Vec3d(0.0); }),
                                     {solid, solid}, {}, 0.01);
  double inside = 0.0;
  for (auto it = deficit->cbeginValueOn(); it; ++it)
    inside += after->tree().getValue(it.getCoord()) < 0.0f ? double(*it) * std::pow(kVoxel, 3) : 0.0;
  CHECK(inside > 0.98 * sumOf(*deficit));
}

TEST_CASE("volume deficit: what leaves the domain and what sources put in is not in it") {
  Options options;
  options.size = Vec3d(1.0);
  options.resolution = kCells;
  options.sides.fill(Side::open);
  const SolidField open = *Solids(options).at(0.0);
  const auto slab = phiOf([](const Vec3d& x) { return x[2] - 0.5; });
  const auto nothing = phiOf([](const Vec3d&) { return 1.0; });
  // One cell through the open side, in ten steps of it.
  FloatGrid::Ptr deficit;
  const Velocity down = flow([](const Vec3d&) { return Vec3d(0.0, 0.0, -1.0); });
  const auto lower = phiOf([](const Vec3d& x) { return x[2] - 0.5 + 2.0 * kVoxel; });
  deficit = volumeDeficit({*slab, *lower}, down, {open, open}, {}, 2.0 * kVoxel);
  CHECK(std::abs(sumOf(*deficit)) < 1e-4);

  const SolidField closed = box();
  SourceGrids source;
  source.phi = phiOf(ball);
  RunningFlows flows;
  flows.sources.push_back({&source, 1.0});
  const Velocity still = flow([](const Vec3d&) { return Vec3d(0.0); });
  CHECK(volumeDeficit({*nothing, *source.phi}, still, {closed, closed}, flows, 0.01)->empty());
}

TEST_CASE("volume deficit: it stays on its side of a wall thinner than a cell") {
  // The centres at 17.5 lie in the wall, and these cells belong to the upper side.
  const double low = 16.9 * kVoxel, top = 17.64 * kVoxel;
  Options options;
  options.size = Vec3d(1.0);
  options.resolution = kCells;
  Solid wall;
  wall.shape = {Box{Vec3d(-1.0, -1.0, low), Vec3d(2.0, 2.0, top)}};
  options.solids.push_back(wall);
  const SolidField solid = *Solids(options).at(0.0);
  const Velocity still = flow([](const Vec3d&) { return Vec3d(0.0); });
  const auto below = [](const FloatGrid& deficit) {
    double sum = 0.0;
    for (auto it = deficit.cbeginValueOn(); it; ++it)
      sum += it.getCoord().z() < 17 ? double(*it) * std::pow(kVoxel, 3) : 0.0;
    return sum;
  };
  SECTION("in liquid") {
    const auto before = phiOf([&](const Vec3d& x) { return x[2] - top - 1.6 * kVoxel; });
    const auto after = phiOf([&](const Vec3d& x) { return x[2] - top - 1.2 * kVoxel; });
    const auto deficit = volumeDeficit({*before, *after}, still, {solid, solid}, {}, 0.01);
    CHECK(sumOf(*deficit) == Approx(0.4 * kVoxel));
    CHECK(below(*deficit) == 0.0);
  }
  SECTION("in the air, with liquid on the other side") {
    const auto phi = phiOf([&](const Vec3d& x) { return low - x[2]; });
    const auto before = FloatGrid::create(0.0f);
    before->setTransform(cellTransform(kVoxel));
    before->tree().setValueOn(Coord(16, 16, 16), 0.3f);
    const auto deficit = volumeDeficit({*phi, *phi, before.get()}, still, {solid, solid}, {}, 0.01);
    CHECK(below(*deficit) == Approx(0.3 * std::pow(kVoxel, 3)));
  }
}

TEST_CASE("volume deficit: beside a drain no liquid comes out of nothing") {
  // The surface of a slab rises towards a drain above it, which no flow has done.
  const SolidField solid = box();
  const auto before = phiOf([](const Vec3d& x) { return x[2] - 0.5; });
  const auto after = phiOf([](const Vec3d& x) { return x[2] - 0.5 - 0.4 * kVoxel; });
  const auto drain = phiOf([](const Vec3d& x) { return 0.5 + 0.6 * kVoxel - x[2]; });
  RunningFlows flows;
  flows.drains.push_back(drain.get());
  const Velocity still = flow([](const Vec3d&) { return Vec3d(0.0); });
  const auto deficit = volumeDeficit({*before, *after}, still, {solid, solid}, flows, 0.01);
  const double gained = liquidVolume(*after, solid) - liquidVolume(*before, solid);
  CHECK(gained == Approx(0.4 * kVoxel));
  CHECK(sumOf(*deficit) == Approx(-gained));
  // What the surface has lost there the drain has taken.
  CHECK(volumeDeficit({*after, *before}, still, {solid, solid}, flows, 0.01)->empty());
}

TEST_CASE("volume deficit: a source that holds its place has none, wherever cells are cut by its edges") {
  const SolidField closed = box();
  const double low = 10.4 * kVoxel, high = 20.4 * kVoxel;  // centres lie 0.1 cell outside
  const auto shape = [&](const Vec3d& x) {
    const Vec3d far = openvdb::math::maxComponent(Vec3d(low) - x, x - Vec3d(high));
    const Vec3d out = openvdb::math::maxComponent(far, Vec3d(0.0));
    return out.lengthSqr() > 0.0 ? out.length() : std::max({far[0], far[1], far[2]});
  };
  SourceGrids source;
  source.phi = phiOf(shape);
  RunningFlows flows;
  flows.sources.push_back({&source, 1.0});
  const Velocity still = flow([](const Vec3d&) { return Vec3d(0.0); });
  FloatGrid::Ptr deficit;
  for (int n = 0; n < 3; ++n)
    deficit = volumeDeficit({*source.phi, *source.phi, deficit.get()}, still, {closed, closed}, flows, 0.01);
  CHECK(std::abs(sumOf(*deficit)) < 0.01 * std::pow(kVoxel, 3));
}

TEST_CASE("volume deficit: a source without velocity in a pool that falls gives no more than its part") {
  // The surface falls through the source's upper cells, of which 0.7 are the source's.
  const SolidField closed = box();
  const double top = 16.2 * kVoxel;
  const auto body = [&](const Vec3d& x) {
    return (x - Vec3d(0.5, 0.5, top - 5.0 * kVoxel)).length() - 5.0 * kVoxel;
  };
  SourceGrids source;
  source.phi = phiOf(body);
  RunningFlows flows;
  flows.sources.push_back({&source, 1.0});
  const auto pool = [&](double level) {
    return phiOf([&, level](const Vec3d& x) { return std::min(x[2] - level, body(x)); });
  };
  const double step = 0.25 * kVoxel;
  const Velocity down = flow([](const Vec3d&) { return Vec3d(0.0, 0.0, -1.0); });
  FloatGrid::Ptr deficit;
  double before = 0.0, after = 0.0;
  for (int n = 0; n < 8; ++n) {
    const double level = 17.0 * kVoxel - n * step;
    deficit = volumeDeficit({*pool(level), *pool(level - step), deficit.get()}, down, {closed, closed}, flows,
                            step);
    (n < 4 ? before : after) = sumOf(*deficit);
  }
  CAPTURE(before, after);
  CHECK(std::abs(after - before) < 8.0 * std::pow(kVoxel, 3));
}

TEST_CASE("volume deficit: none in a cell is more than it holds, and nothing goes through a wall") {
  for (const float share : {5.0f, -5.0f}) {
    Options options;
    options.resolution = kCells;
    options.solids.resize(1);
    options.solids[0].shape = {Box{Vec3d(0.5, -1.0, -1.0), Vec3d(0.52, 2.0, 2.0)}};  // less than a cell
    const SolidField solid = *Solids(options).at(0.0);
    const auto phi = phiOf([](const Vec3d& x) { return (x - Vec3d(0.2)).length() - 0.1; });
    auto deficit = FloatGrid::create(0.0f);
    deficit->setTransform(cellTransform(kVoxel));
    const Coord cell(15, 20, 0);  // beside the wall, on the floor
    deficit->tree().setValueOn(cell, share);
    const auto after = volumeDeficit({*phi, *phi, deficit.get()},
                                     flow([](const Vec3d&) { return Vec3d(0.0); }), {solid, solid}, {}, 1e-6);
    CHECK(totalDeficit(*after) == Catch::Detail::Approx(share * std::pow(kVoxel, 3)).epsilon(1e-4));
    double beyond = 0.0, most = 0.0;
    for (auto it = after->cbeginValueOn(); it; ++it) {
      if (it.getCoord()[0] > 16) beyond = std::max(beyond, std::abs(double(*it)));
      most = std::max(most, std::abs(double(*it)));
    }
    CHECK(beyond == 0.0);
    CHECK(most <= 1.01);
  }
}
