// Solids that change their shape: what they do to the liquid, and how they are drawn.
#include "sim/shapes/pose.h"
#include "sim/shapes/shape_triangles.h"
#include "sim/solids/solids.h"
#include "sim/step/solver.h"
#include "sim/step/state_io.h"
#include "tests/sim/meshes/mesh_files.h"
#include "tests/threads.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <memory>

using namespace fluidtex::sim;
using openvdb::Vec3f;

namespace {

// A basin 1 x 0.5 x 0.5 m, half full.
Options basin(const Solid& solid, int resolution = 24) {
  Options options;
  options.size = Vec3d(1.0, 0.5, 0.5);
  options.resolution = resolution;
  options.cfl = 1.0;
  options.liquid = {{Shape{Box{Vec3d(-1.0), Vec3d(2.0, 2.0, 0.26)}}, Vec3d(0.0), 0.0}};
  options.solids = {solid};
  return options;
}

// Of the surface above the basin's floor, metres.
double meanLevel(const State& state) {
  const double h = basin(Solid{}).voxelSize();
  double level = 0.0;
  int columns = 0;
  for (int i = 0; i < 24; ++i) {
    for (int j = 0; j < 12; ++j, ++columns) {
      const auto phi = [&](int k) { return state.phi->tree().getValue(Coord(i, j, k)); };
      int k = 11;
      while (k > 0 && phi(k) >= 0.0f) --k;
      level += (k + 0.5 + phi(k) / (phi(k) - phi(k + 1))) * h;
    }
  }
  return level / columns;
}

// A box on the floor at the left that becomes 0.2 m longer and 0.08 m higher within a second.
Files expansion() {
  std::vector<std::string> texts;
  for (int n = 0; n < 5; ++n) {
    const double part = 0.25 * n;
    texts.push_back(boxObj(Vec3d(-0.2), Vec3d(0.2 + 0.2 * part, 0.7, 0.08 + 0.08 * part)));
  }
  Files files(texts);
  files.sequence.frameRate = 4.0;
  files.sequence.start = 0.1;
  return files;
}

}  // namespace

TEST_CASE("deforming solids: the surface moves with the velocity that the liquid is told") {
  // Swelling, turned and moved at once: d(distance)/dt = -velocity . normal on the surface.
  Files files({boxObj(Vec3d(-0.2), Vec3d(0.2)), boxObj(Vec3d(-0.3, -0.2, -0.2), Vec3d(0.5, 0.3, 0.5))});
  files.sequence.frameRate = 1.0;
  Solid solid = solidOf(files.sequence);
  solid.keyframes = {{0.0, Vec3d(0.5), 20.0}, {1.0, Vec3d(0.55, 0.5, 0.45), 50.0}};
  Options options;
  options.resolution = 48;
  options.solids = {solid};
  Solids solids(options);
  const double t = 0.4, dt = 1e-3, h = options.voxelSize();
  const auto field = solids.at(t);
  const auto speedAt = [&](const FloatGrid& grid, const Vec3d& x) {
    return double(grid.tree().getValue(Coord::round(grid.worldToIndex(x))));
  };
  const Pose pose = poseAt(solid, t);
  int checked = 0;
  // The middles of the body's sides at this time.
  const Vec3d low(-0.24, -0.2, -0.2), high(0.32, 0.24, 0.32), middle = 0.5 * (low + high);
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool up : {false, true}) {
      Vec3d x = middle, out(0.0);
      x[axis] = up ? high[axis] : low[axis];
      out[axis] = up ? 1.0 : -1.0;
      const Vec3d at = pose.toWorld(x), normal = pose.directionToWorld(out);
      CHECK(std::abs(solids.distance(at, t)) < 0.02 * h);
      const double change = (solids.distance(at, t + dt) - solids.distance(at, t - dt)) / (2.0 * dt);
      const Vec3d v(speedAt(*field->speed.component[0], at), speedAt(*field->speed.component[1], at),
                    speedAt(*field->speed.component[2], at));
      // A face's middle lies up to half a cell away.
      CHECK(change == Approx(-v.dot(normal)).margin(0.01));
      checked += std::abs(change) > 0.05;
    }
  }
  CHECK(checked >= 3);
  CHECK(solids.nextChange(0.0) == 1.0);
  CHECK(solids.nextChange(1.0) == kForever);
}

TEST_CASE("deforming solids: one that only moves makes the flow of one with keyframes") {
  std::vector<std::string> texts;
  const Vec3d low(-0.1, -0.1, -0.1), high(0.15, 0.6, 0.4), far(0.08, 0.0, 0.0);
  for (int n = 0; n < 4; ++n) texts.push_back(boxObj(low + (n / 3.0) * far, high + (n / 3.0) * far));
  Files files(texts);
  files.sequence.frameRate = 6.0;
  Solid keyed;
  keyed.shape.kind = Box{low, high};
  keyed.keyframes = {{0.0, Vec3d(0.0), 0.0}, {0.5, far, 0.0}};
  const Options a = basin(keyed), b = basin(solidOf(files.sequence));

  // Where the liquid is; at the box's edges a mesh's distance is rounded, and deep inside nobody asks for a
  // velocity.
  const auto inside = [](const Coord& at) {
    return at[0] >= 5 && at[1] >= 0 && at[2] >= 0 && at[0] < 24 && at[1] < 12 && at[2] < 8;
  };
  Solids keyedSolids(a), formedSolids(b);
  for (const double t : {0.0, 0.1, 0.25, 0.6}) {
    const auto one = keyedSolids.at(t), other = formedSolids.at(t);
    const std::pair<FloatGrid::Ptr, FloatGrid::Ptr> grids[] = {
        {one->phi, other->phi},
        {one->open.component[0], other->open.component[0]},
        {one->speed.component[0], other->speed.component[0]}};
    for (const auto& [grid, same] : grids) {
      REQUIRE((grid == nullptr) == (same == nullptr));
      if (grid == nullptr) continue;
      for (auto it = grid->cbeginValueOn(); it; ++it) {
        if (it.isVoxelValue() && inside(it.getCoord()) && one->phi->tree().isValueOn(it.getCoord()))
          REQUIRE(same->tree().getValue(it.getCoord()) == Approx(*it).margin(1e-5));
      }
    }
  }

  Solver moved(a), formed(b);
  for (int n = 1; n <= 12; ++n) {
    const double volume = moved.next().stats.volume;
    CHECK(formed.next().stats.volume == Approx(volume).epsilon(1e-3));
    const State &one = moved.state(), &other = formed.state();
    const std::pair<FloatGrid::Ptr, FloatGrid::Ptr> grids[] = {
        {one.velocity.component[0], other.velocity.component[0]},
        {one.velocity.component[1], other.velocity.component[1]},
        {one.velocity.component[2], other.velocity.component[2]}};
    double all = 0.0, apart = 0.0;
    for (const auto& [grid, same] : grids) {
      for (auto it = grid->cbeginValueOn(); it; ++it) {
        const Coord at = it.getCoord();
        if (one.phi->tree().getValue(at) > 0.0f || !inside(at)) continue;
        const double less = *it - same->tree().getValue(at);
        all += *it * *it;
        apart += less * less;
      }
    }
    CHECK(all > 0.0);
    CHECK(std::sqrt(apart / all) < 0.01);
  }
}

TEST_CASE("deforming solids: a floor that swells lifts the surface by its volume") {
  // From 0.08 to 0.24 m within a second, in a tank that it fills from side to side.
  std::vector<std::string> texts;
  for (int n = 0; n < 3; ++n) texts.push_back(boxObj(Vec3d(-0.2), Vec3d(1.2, 0.7, 0.08 + 0.08 * n)));
  Files files(texts);
  files.sequence.frameRate = 2.0;
  Solver solver(basin(solidOf(files.sequence)));
  for (int n = 1; n <= 13; ++n) solver.next();
  // Half-way, all of the liquid moves as the floor does.
  for (auto it = solver.state().velocity.component[2]->cbeginValueOn(); it; ++it) {
    const Coord at = it.getCoord();
    if (solver.state().phi->tree().getValue(at) < 0.0f && at[2] > 5 && at[0] >= 0 && at[0] < 24)
      REQUIRE(*it == Approx(0.16).margin(0.02));
  }
  for (int n = 14; n <= 26; ++n) solver.next();
  CHECK(meanLevel(solver.state()) - 0.26 == Approx(0.16).epsilon(0.02));
}

TEST_CASE("deforming solids: what swells in a basin takes its place from the liquid and keeps its volume") {
  const Files files = expansion();
  Solver solver(basin(solidOf(files.sequence)));
  const double first = solver.next().stats.volume;
  CHECK(first == Approx((1.0 * 0.26 - 0.2 * 0.08) * 0.5).epsilon(0.005));
  for (int n = 2; n <= 29; ++n) CHECK(std::abs(solver.next().stats.volume / first - 1.0) < 0.02);
}

TEST_CASE("deforming solids: the same bytes on any number of threads, and from a state that was kept") {
  const Files files = expansion();
  Options options = basin(solidOf(files.sequence), 16);
  options.solids[0].wall.kind = WallKind::noSlip;
  options.viscosity = 5.0;
  const auto bytesOf = [](const State& state) {
    std::string bytes;
    for (const auto& grid :
         {state.phi, state.velocity.component[0], state.velocity.component[1], state.velocity.component[2]})
      for (auto leaf = grid->tree().cbeginLeaf(); leaf; ++leaf)
        bytes.append(reinterpret_cast<const char*>(leaf->buffer().data()), sizeof(float) * kLeafSize);
    return bytes;
  };
  const auto run = [&](int threads, int cut) {
    return onThreads(threads, [&] {
      auto solver = std::make_unique<Solver>(options);
      for (int n = 1; n <= 8; ++n) {
        solver->next();
        if (n == cut) {
          writeState(solver->state(), files.folder / "state.vdb");
          solver = std::make_unique<Solver>(options, readState(files.folder / "state.vdb"));
        }
      }
      return bytesOf(solver->state());
    });
  };
  const std::string whole = run(1, 0);
  CHECK((run(4, 0) == whole));
  CHECK((run(2, 5) == whole));
}

TEST_CASE("triangulate: a deforming solid is drawn as it is at the time") {
  Files files({boxObj(Vec3d(0.2), Vec3d(0.4)), boxObj(Vec3d(0.2), Vec3d(0.8)),
               boxObj(Vec3d(0.2), Vec3d(0.8, 0.8, 1.6))});
  files.sequence.frameRate = 2.0;
  Solid solid = solidOf(files.sequence);
  const auto volumeAt = [&](double t) {
    return volumeOf(triangulate(solid, t, openvdb::BBoxd(Vec3d(0.0), Vec3d(1.0)), 0.02));
  };
  CHECK(volumeAt(0.0) == Approx(0.008));
  CHECK(volumeAt(0.25) == Approx(0.064));
  CHECK(volumeAt(0.5) == Approx(0.216));
  CHECK(volumeAt(7.0) == Approx(0.36 * 0.8).epsilon(0.01));  // cut off at the domain's top
  solid.keyframes = {{0.0, Vec3d(0.1, 0.0, 0.0), 0.0}};
  const TriangleMesh moved = triangulate(solid, 0.25, openvdb::BBoxd(Vec3d(0.0), Vec3d(1.0)), 0.02);
  float right = 0.0f;
  for (const Vec3f& x : moved.positions) right = std::max(right, x.x());
  CHECK(right == Approx(0.7));
}
