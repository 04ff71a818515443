#include "sim/surface/curvature.h"

#include "sim/pressure/pressure.h"
#include "sim/solids/solids.h"
#include "sim/step/solver.h"
#include "sim/surface/level_set.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstring>
#include <functional>

using namespace fluidtex::sim;

namespace {

FloatGrid::Ptr phiOf(int cells, const std::function<double(const Vec3d&)>& distance) {
  const double h = 1.0 / cells;
  const auto phi = makePhi(h, 4 * h);
  unite(*phi, distance, grown(firstCells(Coord(cells)), kLeafDim));
  return phi;
}

double ball(const Vec3d& x) {
  return (x - Vec3d(0.52, 0.49, 0.503)).length() - 0.25;
}

// In the open.
FloatGrid::Ptr curvatureOf(const FloatGrid& phi) {
  return surfaceCurvature(phi, *makePhi(phi.voxelSize()[0], 3 * phi.voxelSize()[0]));
}

// Largest error of the active curvatures, relative.
double errorOf(const FloatGrid& curvature, double exact) {
  double most = 0.0;
  CHECK(curvature.activeVoxelCount() > 100);
  for (auto it = curvature.cbeginValueOn(); it; ++it) most = std::max(most, std::abs(*it / exact - 1.0));
  return most;
}

bool same(const FloatGrid& a, const FloatGrid& b) {
  if (!a.tree().hasSameTopology(b.tree())) return false;
  auto other = b.tree().cbeginLeaf();
  for (auto leaf = a.tree().cbeginLeaf(); leaf; ++leaf, ++other)
    if (std::memcmp(leaf->buffer().data(), other->buffer().data(), sizeof(float) * kLeafSize) != 0)
      return false;
  return true;
}

// Velocities after one projection of a pool at rest with this surface tension.
Velocity pool(double surfaceTension, bool ripple) {
  Options options;
  options.resolution = 16;
  const auto solid = Solids(options).at(0.0);
  const auto phi =
      phiOf(16, [&](const Vec3d& x) { return x[2] - 0.47 + (ripple ? 0.01 * std::cos(12.0 * x[0]) : 0.0); });
  Velocity velocity = makeVelocity(1.0 / 16, phi->constTree());
  PressureOptions pressure;
  pressure.surfaceTension = surfaceTension;
  CHECK(project(velocity, *phi, *solid, 0.01, 1000.0, pressure).report.converged);
  return velocity;
}

}  // namespace

TEST_CASE("curvature: that of a ball, of second order") {
  const double coarse = errorOf(*curvatureOf(*phiOf(32, ball)), 8.0),
               fine = errorOf(*curvatureOf(*phiOf(64, ball)), 8.0);
  CHECK(coarse < 0.03);
  CHECK(fine < 0.3 * coarse);
}

TEST_CASE("curvature: of a bubble it is negative, of a plane none, of a tiny drop that of two cells") {
  CHECK(errorOf(*curvatureOf(*phiOf(32, [](const Vec3d& x) { return -ball(x); })), -8.0) < 0.03);
  const Vec3d up = Vec3d(0.3, -0.5, 0.8).unit();
  const auto plane = curvatureOf(*phiOf(32, [&](const Vec3d& x) { return (x - Vec3d(0.5)).dot(up); }));
  for (auto it = plane->cbeginValueOn(); it; ++it) CHECK(std::abs(*it) < 1e-3);
  const auto tiny = phiOf(32, [](const Vec3d& x) { return (x - Vec3d(0.5)).length() - 1.2 / 32; });
  const auto round = curvatureOf(*tiny);
  for (auto it = round->cbeginValueAll(); it; ++it) CHECK(std::abs(*it) <= 32.0f);
}

TEST_CASE("curvature: a drop on a wall bends as if it went on behind it as its mirror image") {
  for (const Vec3d& up : {Vec3d(0.0, 0.0, 1.0), Vec3d(0.3, -0.5, 0.8).unit()}) {
    const Vec3d middle = Vec3d(0.5);
    // Behind the wall the level set goes straight on.
    const auto phi = phiOf(64, [&](const Vec3d& x) {
      const double height = std::max(0.0, (x - middle).dot(up));
      const Vec3d along = x - middle - (x - middle).dot(up) * up;
      return std::hypot(height, along.length()) - 0.25;
    });
    const auto wall = phiOf(64, [&](const Vec3d& x) { return (x - middle).dot(up); });
    const auto curvature = surfaceCurvature(*phi, *wall);
    int count = 0;
    for (auto it = curvature->cbeginValueOn(); it; ++it) {
      const double height = (phi->indexToWorld(it.getCoord()) - middle).dot(up);
      if (height < 0.0) continue;
      count += height < 1.0 / 64;
      // Between cells the image is interpolated.
      CHECK(std::abs(*it / 8.0 - 1.0) < (up[2] == 1.0 ? 0.02 : 0.1));
    }
    CHECK(count > 100);
  }
}

TEST_CASE("curvature: the foot of a front bends, however flat it meets the floor") {
  constexpr int kCells = 24;
  const double h = 1.0 / kCells;
  for (const double degrees : {20.0, 40.0, 70.0}) {
    const double angle = degrees * M_PI / 180.0;
    const auto phi = phiOf(
        kCells, [&](const Vec3d& x) { return (x[0] - 0.51) * std::sin(angle) + x[2] * std::cos(angle); });
    Options options;
    options.resolution = kCells;
    const auto solid = Solids(options).at(0.0);
    const auto curvature = surfaceCurvature(*phi, *solid->phi);
    CAPTURE(degrees);
    // The cells that the surface enters last.
    const int foot = static_cast<int>(0.51 * kCells - 0.5 / std::tan(angle));
    float bend = 0.0f;
    CHECK(curvature->tree().probeValue(Coord(foot, 12, 0), bend));
    CHECK(bend * h > 0.3 * std::cos(angle));
    CHECK(bend * h <= 1.0);
  }
}

TEST_CASE("curvature: level liquid in a cup of thin walls has none, in its corners either") {
  for (const double thickness : {0.6, 0.8, 0.95, 1.2, 1.6}) {
    for (const double begin : {3.1, 3.4, 3.65, 3.9}) {
      Options options;
      options.resolution = 16;
      const double h = options.voxelSize(), end = begin + 7.05;
      const Box inside{Vec3d(begin) * h, Vec3d(end, end, 15.0) * h};
      const Box outside{Vec3d(begin - thickness) * h, Vec3d(end + thickness, end + thickness, 13.0) * h};
      options.solids.resize(1);
      options.solids[0].shape = {Difference{{{outside}, {inside}}}};
      options.liquid.push_back({{Box{inside.min, Vec3d(end, end, 8.54) * h}}});
      Solver solver(options);
      solver.next();
      const auto solid = Solids(options).at(0.0);
      const auto curvature = surfaceCurvature(*solver.state().phi, *solid->phi, solid->visibility.get());
      CAPTURE(thickness, begin);
      int count = 0;
      for (auto it = curvature->cbeginValueOn(); it; ++it) {
        const Vec3d x = (it.getCoord().asVec3d() + Vec3d(0.5)) * h;
        if (!openvdb::BBoxd(inside.min, inside.max).isInside(x)) continue;
        ++count;
        CAPTURE(it.getCoord()[0], it.getCoord()[1], it.getCoord()[2]);
        CHECK(std::abs(*it) * h < 1e-3);
      }
      CHECK(count >= 2 * 49);
    }
  }
}

TEST_CASE("surface tension: none changes no bit, and a flat surface does not feel it") {
  const Velocity without = pool(0.0, true), flat = pool(10.0, false), rippled = pool(10.0, true);
  for (int a = 0; a < 3; ++a) {
    for (auto it = without.component[a]->cbeginValueOn(); it; ++it) CHECK(*it == 0.0f);
    for (auto it = flat.component[a]->cbeginValueOn(); it; ++it) CHECK(std::abs(*it) < 1e-5f);
  }
  float most = 0.0f;
  for (auto it = rippled.component[2]->cbeginValueOn(); it; ++it) most = std::max(most, std::abs(*it));
  CHECK(most > 1e-4f);
}

TEST_CASE("surface tension: a square drop draws itself together, alike from run to run") {
  Options options;
  options.resolution = 24;
  options.gravity = Vec3d(0.0);
  options.surfaceTension = 10.0;
  options.liquid = {{Shape{Box{Vec3d(0.3), Vec3d(0.7)}}}};
  // The last cell inside one of the cube's edges.
  const auto edge = [](const Solver& solver) { return solver.state().phi->tree().getValue(Coord(7, 7, 12)); };
  Solver solver(options), again(options);
  const Frame first = solver.next();
  again.next();
  CHECK(edge(solver) < 0.0f);
  for (int n = 0; n < 2; ++n) {
    const Frame frame = solver.next();
    again.next();
    CHECK(frame.stats.volume == Approx(first.stats.volume).epsilon(0.03));
  }
  CHECK(edge(solver) > 0.0f);
  CHECK(same(*solver.state().phi, *again.state().phi));
}
