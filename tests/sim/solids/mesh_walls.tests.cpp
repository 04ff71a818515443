// Walls made of meshes hold what walls of boxes and cylinders do, and as they do.
#include "sim/solids/solids.h"
#include "tests/sim/meshes/mesh_files.h"
#include "tests/sim/meshes/written_files.h"
#include "tests/sim/step/solver_scenes.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <sstream>

using namespace fluidtex::sim;
using Catch::Matchers::Contains;

namespace {

// An open cup: what is `inner` wide (to each side of its axis) and `depth` deep within, turned by `tilt`
// radians about an axis across it.
struct Cup {
  bool round = false;
  double wall = 0.05, tilt = 0.0;
  double inner = 0.2371, depth = 0.513;
  Vec3d floor{0.5113, 0.4931, 0.2317};  // the middle of its floor within, before it is turned

  Pose pose() const {
    Pose pose;
    pose.pivot = floor + Vec3d(0.0, 0.0, 0.5 * depth);
    pose.axis = Vec3d(0.36, 0.93, 0.0).unit();
    pose.angle = tilt;
    return pose;
  }
  Vec3d at(double out, double up) const { return pose().toWorld(floor + Vec3d(out, 0.0, up)); }
  Vec3d up() const { return pose().directionToWorld(Vec3d(0.0, 0.0, 1.0)); }
  // Where two thirds of the cup's height are.
  double level() const { return floor.z() + 2.0 / 3.0 * depth; }

  // How far out of its axis a place is, and how high above its floor.
  std::array<double, 2> across(const Vec3d& x) const {
    const Vec3d d = pose().toBody(x) - floor;
    return {round ? std::hypot(d.x(), d.y()) : std::max(std::abs(d.x()), std::abs(d.y())), d.z()};
  }

  Solid ofShapes() const {
    Solid solid;
    const Vec3d wide(inner + wall, inner + wall, 0.0), narrow(inner, inner, 0.0), high(0.0, 0.0, depth);
    if (round) {
      solid.shape = {Difference{{{Cylinder{at(0.0, -wall), at(0.0, depth), inner + wall}},
                                 {Cylinder{at(0.0, 0.0), at(0.0, 2.0 * depth), inner}}}}};
    } else {
      solid.shape = {Difference{{{Box{floor - wide - Vec3d(0.0, 0.0, wall), floor + wide + high}},
                                 {Box{floor - narrow, floor + narrow + 2.0 * high}}}}};
      solid.pivot = pose().pivot;
      solid.axis = pose().axis;
      solid.keyframes = {{0.0, Vec3d(0.0), tilt * 180.0 / std::numbers::pi}};
    }
    return solid;
  }

  // The same, turned from its outline: in 4 or 96 steps around.
  std::string obj() const {
    const std::vector<std::array<double, 2>> outline{
        {0.0, -wall}, {inner + wall, -wall}, {inner + wall, depth}, {inner, depth}, {inner, 0.0}, {0.0, 0.0}};
    const int steps = round ? 96 : 4, count = int(outline.size());
    const double size = round ? 1.0 : std::numbers::sqrt2;
    std::ostringstream text;
    text.precision(10);
    for (const auto& [out, height] : outline) {
      for (int n = 0; n < steps; ++n) {
        const double angle = (2.0 * n + 1.0) * std::numbers::pi / steps;
        const Vec3d x =
            pose().toWorld(floor + Vec3d(size * out * std::cos(angle), size * out * std::sin(angle), height));
        text << "v " << x.x() << " " << x.y() << " " << x.z() << "\n";
      }
    }
    // Those on the axis are all the same.
    for (int i = 0; i + 1 < count; ++i)
      for (int n = 0; n < steps; ++n) {
        const int next = (n + 1) % steps, low = i * steps + 1, high = low + steps;
        text << "f " << low + n << " " << low + next << " " << high + next << " " << high + n << "\n";
      }
    return text.str();
  }

  // In all of its room up to the level.
  Shape liquid() const {
    if (round)
      return {Difference{{{Cylinder{at(0.0, 0.0), at(0.0, 2.0 * depth), inner}},
                          {HalfSpace{Vec3d(0.0, 0.0, level()), Vec3d(0.0, 0.0, -1.0)}}}}};
    Difference room;
    room.parts.push_back({Box{Vec3d(-1.0), Vec3d(2.0, 2.0, level())}});
    for (int side = 0; side < 5; ++side) {
      Vec3d out(0.0);
      out[side / 2] = side % 2 == 0 ? -1.0 : 1.0;  // the floor's last
      const Vec3d place = side < 4 ? floor + inner * out : floor;
      room.parts.push_back({HalfSpace{pose().toWorld(place), -pose().directionToWorld(out)}});
    }
    return {room};
  }
};

Options sceneOf(const Cup& cup, int resolution, Solid solid) {
  Options options = tank(resolution, {{cup.liquid(), Vec3d(0.0), 0.0}});
  options.solids = {std::move(solid)};
  return options;
}

// What of the liquid is in the cup, and what is outside it, in m3.
std::array<double, 2> whereItIs(const Cup& cup, const Options& options, const State& state) {
  const Solids solids(options);
  const double h = options.voxelSize();
  std::array<double, 2> volume{0.0, 0.0};
  for (auto leaf = state.phi->tree().cbeginLeaf(); leaf; ++leaf) {
    for (auto it = leaf->cbeginValueAll(); it; ++it) {
      const Vec3d x = (it.getCoord().asVec3d() + Vec3d(0.5)) * h;
      if (*it >= 0.0f || solids.distance(x, 0.0) <= 0.0) continue;
      const auto [out, up] = cup.across(x);
      volume[out < cup.inner + 0.5 * cup.wall && up > -0.5 * cup.wall ? 0 : 1] += h * h * h;
    }
  }
  return volume;
}

void checkHolds(const Cup& cup, int resolution, int frames) {
  const WrittenFile file("cup.obj", cup.obj());
  Solid mesh;
  mesh.shape.kind = MeshShape{file.path};
  const Options options = sceneOf(cup, resolution, mesh), shapes = sceneOf(cup, resolution, cup.ofShapes());
  Solver solver(options), other(shapes);
  CHECK(solver.warnings().empty());
  const auto held = [](const FrameStats& stats) { return stats.volume + stats.deficit; };
  const double poured = held(solver.next().stats);
  // A polygon of 96 sides is smaller than the circle by a thousandth.
  CHECK(poured == Approx(held(other.next().stats)).epsilon(2e-3));
  for (int n = 0; n < frames; ++n) {
    const FrameStats stats = solver.next().stats;
    REQUIRE(std::abs(held(stats) / poured - 1.0) < 1e-4);
    REQUIRE(std::abs(stats.volume / poured - 1.0) < 0.005);
    other.next();
  }
  const auto [within, outside] = whereItIs(cup, options, solver.state());
  const auto [withinShapes, outsideShapes] = whereItIs(cup, shapes, other.state());
  CHECK(outside == 0.0);
  CHECK(outsideShapes == 0.0);
  CHECK(within == Approx(withinShapes).epsilon(0.01));
}

}  // namespace

TEST_CASE("mesh walls: cups with walls of 0.6 and 1 cell hold what is in them, as those of shapes do") {
  constexpr int kResolution = 24;
  const auto [round, cells, tilt] = GENERATE(table<bool, double, double>(
      {{false, 0.6, 20.0}, {false, 1.0, 0.0}, {true, 0.6, 0.0}, {true, 1.0, 20.0}}));
  CAPTURE(round, cells, tilt);
  Cup cup;
  cup.round = round;
  cup.wall = cells / kResolution;
  cup.tilt = tilt * std::numbers::pi / 180.0;
  checkHolds(cup, kResolution, 12);
}

TEST_CASE("mesh walls: square and round cups hold for a second", "[long]") {
  constexpr int kResolution = 28;
  const bool round = GENERATE(false, true);
  const double cells = GENERATE(0.6, 1.0, 1.5, 2.0), tilt = GENERATE(0.0, 20.0);
  CAPTURE(round, cells, tilt);
  Cup cup;
  cup.round = round;
  cup.wall = cells / kResolution;
  cup.tilt = tilt * std::numbers::pi / 180.0;
  checkHolds(cup, kResolution, 30);
}

TEST_CASE("mesh walls: a mesh is as far away as the box that it shows, where no lattice has a corner in it") {
  const double h = 1.0 / 16.0;
  const Vec3d low(0.3, 0.3, 0.51), high(0.7, 0.7, 0.51 + 0.3 * h);
  const WrittenFile file("plate.obj", boxObj(low, high));
  const ShapeDistance mesh(Shape{MeshShape{file.path}}, h), box(Shape{Box{low, high}}, h);
  int within = 0;
  for (int n = 0; n < 4000; ++n) {
    const auto share = [&](double step) { return std::fmod(n * step, 1.0); };
    const Vec3d x(0.2 + 0.6 * share(0.618034), 0.2 + 0.6 * share(0.754878), 0.4 + 0.25 * share(0.569840));
    if (std::abs(box(x)) > 1.5 * h) continue;
    REQUIRE(mesh(x) == Approx(box(x)).margin(1e-6));
    within += box(x) < 0.0;
  }
  CHECK(within > 50);
}

TEST_CASE("mesh walls: thin ones are warned of as those of shapes are, by their true thickness") {
  constexpr int kResolution = 24;
  Cup cup;
  cup.round = GENERATE(false, true);
  cup.wall = 0.43 / kResolution;
  cup.tilt = GENERATE(0.0, 0.35);
  const WrittenFile file("cup.obj", cup.obj());
  Solid mesh;
  mesh.shape.kind = MeshShape{file.path};
  for (const Solid& solid : {mesh, cup.ofShapes()}) {
    const std::vector<std::string> warnings = Solids(sceneOf(cup, kResolution, solid)).warnings();
    REQUIRE(warnings.size() == 1);
    // 24 * 0.6 / 0.43 is 33.5.
    CHECK_THAT(warnings[0], Contains("less than 0.6 cells") && Contains("domain.resolution = 34"));
    const std::string about = "only about ";
    const double thickness = std::stod(warnings[0].substr(warnings[0].find(about) + about.size()));
    CHECK(thickness == Approx(cup.wall).epsilon(cup.round ? 4e-3 : 3e-3));
    // At a place in the wall, or on its surface.
    const std::size_t open = warnings[0].find('(');
    Vec3d place;
    std::sscanf(warnings[0].c_str() + open, "(%lf, %lf, %lf)", &place[0], &place[1], &place[2]);
    const auto [out, up] = cup.across(place);
    const double besides = std::abs(out - cup.inner - 0.5 * cup.wall), below = std::abs(up + 0.5 * cup.wall);
    CHECK(std::min(besides, below) < 0.55 * cup.wall);
  }
}

TEST_CASE("mesh walls: a sequence of meshes that becomes thin is warned of") {
  constexpr int kResolution = 16;
  const auto plate = [&](double cells) {
    return boxObj(Vec3d(-0.1, -0.1, 0.53), Vec3d(1.1, 1.1, 0.53 + cells / kResolution));
  };
  for (const double last : {1.5, 0.3}) {
    const Files files({plate(2.0), plate(1.8), plate(last), plate(2.0)});
    Options options = tank(kResolution, {});
    options.solids = {solidOf(files.sequence)};
    const std::vector<std::string> warnings = Solids(options).warnings();
    REQUIRE(warnings.size() == (last < 0.6 ? 1 : 0));
    if (last < 0.6) CHECK_THAT(warnings[0], Contains("domain.resolution = 32"));
  }
}

TEST_CASE("mesh walls: what a small cavity holds is its volume") {
  // 3.3 cells a side.
  const double h = 1.0 / 24.0;
  const Vec3d low(0.4123, 0.4307, 0.4211), high = low + Vec3d(3.3 * h);
  const WrittenFile file("cavity.obj", boxObj(low - Vec3d(1.2 * h), high + Vec3d(1.2 * h)) +
                                           boxObj(low, high, "") +
                                           "f 9 12 11 10\nf 13 14 15 16\nf 9 10 14 13\nf 10 11 15 14\n"
                                           "f 11 12 16 15\nf 12 9 13 16\n");
  Options options = tank(24, {box(Vec3d(0.0), Vec3d(1.0))});
  options.liquid[0] = box(low - Vec3d(h), high + Vec3d(h));
  options.solids.resize(1);
  options.solids[0].shape.kind = MeshShape{file.path};
  Options shapes = options;
  shapes.solids[0].shape = {
      Difference{{{Box{low - Vec3d(1.2 * h), high + Vec3d(1.2 * h)}}, {Box{low, high}}}}};
  const auto held = [](const Options& o) { return Solver(o).next().stats.volume; };
  CHECK(held(options) == Approx(held(shapes)).epsilon(1e-3));
}
